#pragma once

#include <type_traits>

#include <omp.h>

#include <geometry/sample_surfaces.h>
#include <sherd/assembly/assembler.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/material/canham.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/solve/instances.h>

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

using StretchSplit = split::SurfaceStretch<material::NeoHooke, material::Canham>;
using Shell        = BrittleShell<2, 3, StretchSplit, degradation::Cubic, crack_density::FourthOrder>;

/// The same in space, c = .02, T = .2.
inline Shell shell(Toughness<3> toughness = 1.1)
{
  return Shell(StretchSplit(material::NeoHooke(2.1, 1.3), material::Canham(.02), {.thickness = .2}),
               degradation::Cubic(), {}, std::move(toughness), .4, 1.7);
}

/// All that is needed to assemble, over the ranks of a communicator.
template <class Model>
struct ModelBody
{
  static constexpr int degree = Model::degree, spacedim = Model::spacedim, n_fields = Model::n_fields;

  using FieldValues = Eigen::Matrix<double, Eigen::Dynamic, n_fields, Eigen::RowMajor>;

  ModelBody(MPI_Comm comm, Surface<degree, spacedim> surface_, Model model_, const std::vector<Tie> &ties = {})
      : surface(std::move(surface_)),
        model(std::move(model_)),
        space(Environment(comm), surface),
        state(space),
        assembler(model, space, state.distribution, ties)
  {
  }
  ModelBody(const ModelBody &)            = delete;
  ModelBody &operator=(const ModelBody &) = delete;

  BalanceLevel level() const { return {state.position, state.acceleration, state.phase}; }
  Vector       make_force() const { return Vector(state.distribution, n_fields); }

  /// Internal and inertial forces on all ranks, shape=(n_points, n_fields).
  FieldValues force() const
  {
    auto f = make_force();
    assembler.force(level(), state.history, f);
    return on_all_ranks(f);
  }

  /// External forces on all ranks, shape=(n_points, n_fields).
  FieldValues loads(const Loads<spacedim> &loads, double time = 0.) const
  {
    auto f = make_force();
    assembler.external_force(level(), assembler.evaluate(loads, time), f);
    return on_all_ranks(f);
  }

  Energies energies() const { return assembler.energies(state.position, state.velocity, state.phase); }

  /// Work withheld if the state were a step from its previous phase, with its history.
  double withheld_work() const { return assembler.withheld_work(level(), state.previous_phase, state.history); }

  static FieldValues on_all_ranks(const Vector &f)
  {
    const auto values = gather(f);
    return Eigen::Map<const FieldValues>(values.data(), values.size() / n_fields, n_fields);
  }

  Surface<degree, spacedim>    surface;
  Model                        model;
  ShellSpace<degree, spacedim> space;
  State<degree, spacedim>      state;
  Assembler<Model>             assembler;
};

/// A sheet in the plane.
struct Body : ModelBody<Sheet>
{
  Body(MPI_Comm comm, Surface<2, 2> surface_, Sheet model_ = sheet())
      : ModelBody(comm, std::move(surface_), std::move(model_))
  {
  }
};

/// The matrix with all entries on all ranks, rows A * block_size + c in the numbering of the surface.
inline Eigen::MatrixXd dense(const Matrix &matrix)
{
  const auto     &d      = matrix.distribution();
  const int       size   = matrix.block_size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size * d.n_global(), size * d.n_global());
  for (int a = 0; a < d.n_owned(); ++a)
    {
      const auto row = matrix.graph().row(a);
      for (std::size_t k = 0; k < row.size(); ++k)
        for (int i = 0; i < size; ++i)
          for (int j = 0; j < size; ++j)
            result(size * d.global(a) + i, size * d.global(row[k]) + j) =
                matrix.values()[matrix.row_start(a) + i * matrix.row_length(a) + size * k + j];
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
template <int degree, int spacedim>
GlobalState<degree, spacedim> random_state(const Surface<degree, spacedim> &surface,
                                           const std::type_identity_t<Eigen::Matrix<double, spacedim, spacedim>> &F,
                                           double disorder = .01)
{
  std::mt19937                  random(31);
  GlobalState<degree, spacedim> state;
  const int                     n     = surface.n_control_points();
  const auto                    field = [&](Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd values(rows, columns);
    for (auto &value : values.reshaped())
      value = symmetric(random);
    return values;
  };
  state.position       = surface.control_points() * F.transpose() + disorder * field(n, spacedim);
  state.velocity       = field(n, spacedim);
  state.acceleration   = field(n, spacedim);
  state.phase          = (.6 + .2 * field(n, 1).array()).matrix();
  state.previous_phase = (.7 + .2 * field(n, 1).array()).matrix();
  state.history        = (.02 + .02 * field(surface.n_elements(), state.n_q).array()).matrix();
  return state;
}

struct DenseSystem
{
  Eigen::VectorXd force;
  Eigen::MatrixXd matrix;
};

/// Sums element arrays on control points, element by element, into dense arrays. Knows no ties.
template <class Model>
DenseSystem assemble_dense(const ModelBody<Model> &body, const GlobalState<Model::degree, Model::spacedim> &state,
                           double mass_weight)
{
  constexpr int dim = Model::spacedim, n_fields = Model::n_fields, n_b = ElementFields<Model>::n_b;
  const int     n = n_fields * body.surface.n_control_points();
  DenseSystem   system{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  for (int e = 0; e < body.surface.n_elements(); ++e)
    {
      const auto            data = element_data(body.model, body.surface, e);
      const Eigen::MatrixXd E    = data.geometry.extraction;
      const int             size = static_cast<int>(E.rows());
      ElementFields<Model>  f{};
      for (int A = 0; A < size; ++A)
        for (int b = 0; b < n_b; ++b)
          {
            const int i = data.geometry.points[A];
            for (int d = 0; d < dim; ++d)
              {
                f.position[d][b] += E(A, b) * state.position(i, d);
                f.acceleration[d][b] += E(A, b) * state.acceleration(i, d);
              }
            f.phase[b] += E(A, b) * state.phase[i];
          }
      const Eigen::Matrix<double, 1, ElementData<Model>::n_q> history = state.history.row(e);
      ElementVector<Model>                                    vector;
      ElementMatrix<Model>                                    tangent;
      element_tangent(body.model, data, f, history.data(), mass_weight, PhaseTangent::consistent, vector, tangent);
      for (int A = 0; A < size; ++A)
        for (int c = 0; c < n_fields; ++c)
          for (int b = 0; b < n_b; ++b)
            system.force[n_fields * data.geometry.points[A] + c] += E(A, b) * vector.value[c][b];
      for (int c = 0; c < n_fields; ++c)
        for (int d = 0; d < n_fields; ++d)
          {
            Eigen::MatrixXd block(n_b, n_b);
            for (int a = 0; a < n_b; ++a)
              for (int b = 0; b < n_b; ++b)
                block(a, b) = tangent.value[c * n_b + a][d * n_b + b];
            block = E * block * E.transpose();
            for (int A = 0; A < size; ++A)
              for (int B = 0; B < size; ++B)
                system.matrix(n_fields * data.geometry.points[A] + c, n_fields * data.geometry.points[B] + d) +=
                    block(A, B);
          }
    }
  return system;
}

/// Sets the number of threads for a while.
class Threads
{
public:
  explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads &)            = delete;
  Threads &operator=(const Threads &) = delete;

private:
  int before_;
};

inline Eigen::Matrix2d stretch(double a, double b, double shear = 0.)
{
  return (Eigen::Matrix2d() << a, shear, 0., b).finished();
}

} // namespace sherd::test
