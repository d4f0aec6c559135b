// label: unit
// ranks: 1 2
#include <catch2/catch.hpp>

#include <assembly/body.h>
#include <sherd/geometry/split.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// The moduli and the bending stiffness of test::shell() times @p moduli, and a factor by position.
Shell stiff_shell(double moduli, StiffnessField<3> stiffness = {})
{
  return Shell(
      StretchSplit(material::NeoHooke(moduli * 2.1, moduli * 1.3), material::Canham(moduli * .02), {.thickness = .2}),
      degradation::Cubic(), {}, 1.1, .4, 1.7, {}, std::move(stiffness));
}

/// A bent sheet of two patches joined by penalty, with everything disturbed.
struct JoinedSheet
{
  Surface<2, 3>    surface = split_patches(shapes::plate<2, 3>({4., 2.}, {4, 2}), {2, 1});
  Shell            model;
  ShellSpace<2, 3> space;
  State<2, 3>      state;
  Assembler<Shell> assembler;

  explicit JoinedSheet(const Shell &model_)
      : model(model_),
        space(Environment(MPI_COMM_WORLD), surface, continuity::Penalty{}),
        state(space),
        assembler(model, space, state.distribution)
  {
    const auto disturbed = random_state(surface, Eigen::DiagonalMatrix<double, 3>(1.02, .99, 1.).toDenseMatrix(), .02);
    state                = distribute(disturbed, space);
  }
  JoinedSheet(const JoinedSheet &) = delete;

  Energies energies() const { return assembler.energies(state.position, state.velocity, state.phase); }

  DenseSystem system() const
  {
    Matrix matrix = assembler.make_matrix();
    Vector force(state.distribution, 4);
    assembler.linearise({state.position, state.acceleration, state.phase}, state.history, .7, PhaseTangent::consistent,
                        force, matrix);
    const auto values = gather(force);
    return {Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())), dense(matrix)};
  }
};

} // namespace

// All laws and splits are homogeneous of degree one in (K, G, c): a factor of 3 everywhere is a material with three
// times the moduli, in the element loop, in the penalty of an interface and in the wave speeds.
TEST_CASE("A constant factor of the stiffness is a stiffer material")
{
  const JoinedSheet by_factor(stiff_shell(1., 3.)), by_moduli(stiff_shell(3.)), plain(stiff_shell(1.));

  const auto expected = by_moduli.energies(), found = by_factor.energies(), soft = plain.energies();
  CHECK(found.active == Approx(expected.active).epsilon(1e-12));
  CHECK(found.passive == Approx(expected.passive).epsilon(1e-12));
  CHECK(found.constraint == Approx(expected.constraint).epsilon(1e-12));
  CHECK(found.elastic() == Approx(3. * soft.elastic()).epsilon(1e-12));
  CHECK(found.constraint > soft.constraint);
  CHECK(found.fracture == Approx(soft.fracture).epsilon(1e-14)); // knows no moduli
  CHECK(found.kinetic == Approx(soft.kinetic).epsilon(1e-14));

  const auto a = by_factor.system(), b = by_moduli.system();
  CHECK((a.force - b.force).cwiseAbs().maxCoeff() < 1e-12 * b.force.cwiseAbs().maxCoeff());
  CHECK((a.matrix - b.matrix).cwiseAbs().maxCoeff() < 1e-12 * b.matrix.cwiseAbs().maxCoeff());

  CHECK(by_factor.assembler.fastest_waves().rayleigh ==
        Approx(by_moduli.assembler.fastest_waves().rayleigh).epsilon(1e-14));
  CHECK(by_factor.assembler.fastest_waves().dilatational ==
        Approx(std::sqrt(3.) * plain.assembler.fastest_waves().dilatational).epsilon(1e-14));
}

TEST_CASE("The stiffest place of all ranks bounds the wave speeds")
{
  Sheet model     = sheet();
  model.stiffness = [](const Point<2> &X) { return X[0] < 1. && X[1] < 1. ? 16. : X[0] > 3. ? .25 : 1.; };
  const Body body(MPI_COMM_WORLD, shapes::plate<2, 2>({4., 4.}, {4, 4}), model);
  CHECK(body.assembler.largest_stiffness() == 16.);
  CHECK(body.assembler.fastest_waves().shear == Approx(4. * std::sqrt(1.3 / 1.7)).epsilon(1e-14));
}

TEST_CASE("A stiffness that is not positive is refused where it is met")
{
  Sheet model     = sheet();
  model.stiffness = [](double x, double) { return 2. - x; };
  CHECK_THROWS_WITH(Body(MPI_COMM_WORLD, shapes::plate<2, 2>({4., 1.}, {4, 1}), model),
                    Catch::Contains("stiffness factor -"));
}
