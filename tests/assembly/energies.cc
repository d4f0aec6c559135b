// label: verification
// ranks: 1 3
#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/state/transfer.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// Refines a body's surface around some control points and carries the state.
struct RefinedPair
{
  RefinedPair(const Surface<2, 2> &surface, const GlobalState<2, 2> &state)
      : coarse(MPI_COMM_WORLD, surface), fine(MPI_COMM_WORLD, refine(surface, state))
  {
    coarse.state = distribute(state, coarse.space);
    fine.state   = distribute(carried, fine.space);
  }

  Surface<2, 2> refine(Surface<2, 2> surface, const GlobalState<2, 2> &state)
  {
    const auto boxes      = element_boxes(surface);
    const auto refinement = surface.refine({1, 10, 14, 21}, {{.5, .5}});
    carried               = transfer(state, boxes, refinement, surface);
    return surface;
  }

  GlobalState<2, 2> carried;
  Body              coarse, fine;
};

} // namespace

TEST_CASE("Energies of a homogeneous state are exact on any mesh")
{
  Body         body(MPI_COMM_WORLD, crowded_plate());
  const double a = 1.15, b = GENERATE(1.02, .7), phi = .7, before = .75, H = .4;
  auto         state = random_state(body.surface, stretch(a, b), 0.);
  state.velocity.col(0).setConstant(3.);
  state.velocity.col(1).setConstant(-4.);
  state.phase.setConstant(phi);
  state.previous_phase.setConstant(before);
  state.history.setConstant(H);
  body.state = distribute(state, body.space);

  const double             J = a * b, area = 16.;
  const double             dil  = 2.1 / 4. * (J * J - 1. - 2. * std::log(J));
  const double             dev  = 1.3 / 2. * ((a * a + b * b) / J - 2.);
  const double             plus = dev + (J > 1. ? dil : 0.);
  const degradation::Cubic g;
  const auto               e = body.energies();
  CHECK(e.active == Approx(area * g.value(phi) * plus).epsilon(1e-12));
  CHECK(e.passive == Approx(area * (J > 1. ? 0. : dil)).epsilon(1e-12).margin(1e-15));
  CHECK(e.kinetic == Approx(area * .5 * 1.7 * 25.).epsilon(1e-13));
  CHECK(e.fracture == Approx(area * 1.1 / 1.6 * .09).epsilon(1e-12));
  CHECK(body.withheld_work() ==
        Approx(area * g.first(.5 * (phi + before)) * (H - plus) * (phi - before)).epsilon(1e-12));
  for (const double intensity : body.assembler.intensity(body.state.history))
    CHECK(intensity == Approx(H / (1.1 / (.8 * (6. - 4e-4)))).epsilon(1e-12));
  for (const auto &density : body.assembler.densities(body.state.position, body.state.phase))
    {
      CHECK(density.elastic == Approx(e.elastic() / area).epsilon(1e-12));
      CHECK(density.fracture == Approx(e.fracture / area).epsilon(1e-12));
    }
}

TEST_CASE("Densities belong to the owned elements and sum to the energies")
{
  Body body(MPI_COMM_WORLD, crowded_plate());
  body.state           = distribute(random_state(body.surface, stretch(1.1, 1.1)), body.space);
  const auto densities = body.assembler.densities(body.state.position, body.state.phase);
  double     sums[2]   = {0., 0.};
  int        k         = 0;
  for (const int e : body.space.distribution().elements)
    if (body.space.distribution().element_owner[e] == body.space.environment().rank())
      {
        double area = 0.;
        for (const auto &q : element_geometry(body.surface, e).reference)
          area += q.dA;
        REQUIRE(k < static_cast<int>(densities.size()));
        sums[0] += densities[k].elastic * area;
        sums[1] += densities[k].fracture * area;
        ++k;
      }
  CHECK(k == static_cast<int>(densities.size()));
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  const auto e = body.energies();
  CHECK(sums[0] == Approx(e.elastic()).epsilon(1e-12));
  CHECK(sums[1] == Approx(e.fracture).epsilon(1e-12));
}

TEST_CASE("Refinement leaves energies and forces unchanged where quadrature is exact")
{
  // Straight parameter lines: crack and kinetic energies are integrals of polynomials of degree 4, which three Gauss
  // points integrate. The elastic energy is one for linear displacements.
  const auto  surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  auto        state   = random_state(surface, stretch(1.2, 1.1, .1), 0.);
  RefinedPair pair(surface, state);
  REQUIRE(pair.fine.surface.n_elements() > 25);
  const auto before = pair.coarse.energies(), after = pair.fine.energies();
  CHECK(after.fracture == Approx(before.fracture).epsilon(1e-13));
  CHECK(after.kinetic == Approx(before.kinetic).epsilon(1e-13));

  state.phase.setConstant(.8);
  RefinedPair uniform(surface, state);
  CHECK(uniform.fine.energies().active == Approx(uniform.coarse.energies().active).epsilon(1e-13));

  // The virtual work of a displacement of the coarse mesh is the same: its coarse control forces are T^T f.
  auto             refined = surface;
  const auto       T       = refined.refine({1, 10, 14, 21}, {{.5, .5}}).transfer;
  const auto       fine = uniform.fine.force(), coarse = uniform.coarse.force();
  ControlValues<3> restricted = ControlValues<3>::Zero(coarse.rows(), 3);
  for (int i = 0; i < T.n_rows(); ++i)
    for (int k = T.offsets[i]; k < T.offsets[i + 1]; ++k)
      restricted.row(T.columns[k]) += T.values[k] * fine.row(i);
  CHECK((restricted - coarse).leftCols<2>().cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("Otherwise the elastic energy changes by the error of the quadrature")
{
  // A smooth displacement, refined everywhere: the energy density is no polynomial, and the error falls with order 6.
  auto surface = shapes::plate<2, 2>({4., 4.}, {4, 4});
  auto state   = random_state(surface, stretch(1.2, 1.15), 0.);
  state.phase.setOnes();
  for (int i = 0; i < surface.n_control_points(); ++i)
    {
      const auto X = surface.control_points().row(i).eval();
      state.position.row(i) += .2 * Eigen::RowVector2d(std::sin(X[1]), std::sin(X[0]));
    }
  double energy[3];
  for (int level = 0; level < 3; ++level)
    {
      Body body(MPI_COMM_WORLD, surface);
      body.state            = distribute(state, body.space);
      energy[level]         = body.energies().elastic();
      const auto boxes      = element_boxes(surface);
      const auto refinement = refine_everywhere(surface, level + 1);
      state                 = transfer(state, boxes, refinement, surface);
    }
  const double first = std::abs(energy[1] - energy[0]), second = std::abs(energy[2] - energy[1]);
  CAPTURE(energy[2], first, second);
  CHECK(first < 1e-4 * energy[2]);
  CHECK(std::log2(first / second) > 5.);
}
