#pragma once

#include <geometry/sample_surfaces.h>
#include <sherd/assembly/assembler.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/material/split/surface_stretch.h>

namespace sherd::test
{

using Sheet =
    BrittleShell<2, 2, split::SurfaceStretch<material::NeoHooke>, degradation::Cubic, crack_density::FourthOrder>;

/// K = 2.1, G = 1.3, l0 = .4, rho = 1.7.
inline Sheet sheet(Toughness<2> toughness = 1.1)
{
  return Sheet(split::SurfaceStretch<material::NeoHooke>(material::NeoHooke(2.1, 1.3)), degradation::Cubic(), {},
               std::move(toughness), .4, 1.7);
}

/// All that is needed to assemble, over the ranks of a communicator.
struct Body
{
  Body(MPI_Comm comm, Surface<2, 2> surface_, Sheet model_ = sheet())
      : surface(std::move(surface_)),
        model(std::move(model_)),
        space(Environment(comm), surface),
        state(space),
        assembler(model, space, state.distribution)
  {
  }
  Body(const Body &)            = delete;
  Body &operator=(const Body &) = delete;

  BalanceLevel level() const { return {state.position, state.acceleration, state.phase}; }
  Vector       make_force() const { return Vector(state.distribution, 3); }

  /// Internal and inertial forces on all ranks, shape=(n_points, 3).
  ControlValues<3> force() const
  {
    auto f = make_force();
    assembler.force(level(), state.history, f);
    return on_all_ranks(f);
  }

  /// External forces on all ranks, shape=(n_points, 3).
  ControlValues<3> loads(const Loads<2> &loads, double time = 0.) const
  {
    auto f = make_force();
    assembler.external_force(level(), assembler.evaluate(loads, time), f);
    return on_all_ranks(f);
  }

  Energies energies() const { return assembler.energies(state.position, state.velocity, state.phase); }

  /// Work withheld if the state were a step from its previous phase, with its history.
  double withheld_work() const { return assembler.withheld_work(level(), state.previous_phase, state.history); }

  static ControlValues<3> on_all_ranks(const Vector &f)
  {
    const auto values = gather(f);
    return Eigen::Map<const ControlValues<3>>(values.data(), values.size() / 3, 3);
  }

  Surface<2, 2>    surface;
  Sheet            model;
  ShellSpace<2, 2> space;
  State<2, 2>      state;
  Assembler<Sheet> assembler;
};

/// The matrix with all entries on all ranks, rows A * 3 + c in the numbering of the surface.
inline Eigen::MatrixXd dense(const Matrix &matrix)
{
  const auto     &d      = matrix.distribution();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * d.n_global(), 3 * d.n_global());
  for (int a = 0; a < d.n_owned(); ++a)
    {
      const auto row = matrix.graph().row(a);
      for (std::size_t k = 0; k < row.size(); ++k)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            result(3 * d.global(a) + i, 3 * d.global(row[k]) + j) =
                matrix.values()[matrix.row_start(a) + i * matrix.row_length(a) + 3 * k + j];
    }
  MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE, MPI_SUM, d.comm());
  return result;
}

/// 4 x 4 unit elements with curved inner lines, refined twice with hanging lines; elements of 9 to 16 functions.
inline Surface<2, 2> crowded_plate()
{
  auto surface = distorted(shapes::plate<2, 2>({4., 4.}, {4, 4}), .15);
  refine_at_random(surface, 2, 3, 73);
  return surface;
}

/// x = F X + u with random u, phase between .4 and .8, random v, a and history; the same on all ranks.
inline GlobalState<2, 2> random_state(const Surface<2, 2> &surface, const Eigen::Matrix2d &F, double disorder = .01)
{
  std::mt19937      random(31);
  GlobalState<2, 2> state;
  const int         n     = surface.n_control_points();
  const auto        field = [&](Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd values(rows, columns);
    for (auto &value : values.reshaped())
      value = symmetric(random);
    return values;
  };
  state.position       = surface.control_points() * F.transpose() + disorder * field(n, 2);
  state.velocity       = field(n, 2);
  state.acceleration   = field(n, 2);
  state.phase          = (.6 + .2 * field(n, 1).array()).matrix();
  state.previous_phase = (.7 + .2 * field(n, 1).array()).matrix();
  state.history        = (.02 + .02 * field(surface.n_elements(), 9).array()).matrix();
  return state;
}

inline Eigen::Matrix2d stretch(double a, double b, double shear = 0.)
{
  return (Eigen::Matrix2d() << a, shear, 0., b).finished();
}

} // namespace sherd::test
