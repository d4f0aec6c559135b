// label: verification
// ranks: 1 3
#include <catch2/catch.hpp>

#include <assembly/body.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

/// First Piola-Kirchhoff stress F S of the sheet under the homogeneous deformation F at the phase phi.
Eigen::Matrix2d piola_stress(const Sheet &model, const Eigen::Matrix2d &F, double phi)
{
  const Eigen::Matrix2d C        = F.transpose() * F;
  const auto            response = model.split.respond(
                 SurfacePoint<2>(ReferencePoint<2>(metric(Voigt(1., 1., 0.))), metric(Voigt(C(0, 0), C(1, 1), C(0, 1)))));
  const Voigt     s = degraded_stress(response, model.degradation.value(phi)).membrane;
  Eigen::Matrix2d S;
  S << s[0], s[2], s[2], s[1];
  return F * S;
}

/// The tractions P N on the four edges of a plate.
Loads<2> tractions(const Eigen::Matrix2d &P)
{
  Loads<2>   loads;
  const auto add = [&](const std::string &edge, const Point<2> &N) {
    const Point<2> t = P * N;
    loads.traction(edge, [t](const Point<2> &, double) { return t; });
  };
  add("left", {-1., 0.});
  add("right", {1., 0.});
  add("bottom", {0., -1.});
  add("top", {0., 1.});
  return loads;
}

struct Mesh
{
  std::string   name;
  Surface<2, 2> surface;
};

std::vector<Mesh> meshes()
{
  const auto        plate = shapes::plate<2, 2>({4., 4.}, {4, 4});
  std::vector<Mesh> result{{"distorted", distorted(plate, .2)}, {"hanging lines", plate}, {"both", crowded_plate()}};
  refine_at_random(result[1].surface, 3, 3, 8);
  return result;
}

} // namespace

TEST_CASE("Patch test: a linear displacement has constant stress and is in balance with its tractions")
{
  for (const auto &mesh : meshes())
    for (const double J : {1.2, .8})
      for (const double phi : {1., .6})
        {
          CAPTURE(mesh.name, J, phi);
          Body body(MPI_COMM_WORLD, mesh.surface);
          auto state = random_state(mesh.surface, Eigen::Matrix2d::Identity(), 0.);
          // Surface stretch J with shear, turned: nothing about it is special.
          const Eigen::Matrix2d F =
              std::sqrt(J) * Eigen::Rotation2Dd(.4).toRotationMatrix() * stretch(1.1, 1. / 1.1, .15);
          state.position = mesh.surface.control_points() * F.transpose();
          state.position.col(0).array() += 3.;
          state.phase.setConstant(phi);
          state.acceleration.setZero();
          body.state = distribute(state, body.space);

          const auto   P        = piola_stress(body.model, F, phi);
          const auto   internal = body.force();
          const auto   external = body.loads(tractions(P));
          const double scale    = internal.leftCols<2>().cwiseAbs().maxCoeff();
          REQUIRE(scale > .02);

          // Forces of neighbouring elements, of size 1, cancel; strains carry the rounding of positions up to 8.
          CHECK((internal - external).leftCols<2>().cwiseAbs().maxCoeff() < 2e-14);

          std::vector<char> on_edge(mesh.surface.n_control_points(), 0);
          for (const auto &[name, sides] : mesh.surface.edges())
            for (const int i : points_along(mesh.surface, sides.front()))
              on_edge[i] = 1;
          double residual   = 0.;
          int    n_interior = 0;
          for (int i = 0; i < mesh.surface.n_control_points(); ++i)
            if (!on_edge[i])
              {
                ++n_interior;
                residual = std::max(residual, internal.row(i).head<2>().cwiseAbs().maxCoeff());
              }
          CHECK(n_interior >= 16);
          CHECK(residual < 2e-14);

          // The energy density is the same everywhere, and P is its derivative in F.
          const auto psi = [&](const Eigen::Matrix2d &G) {
            const double             K = 2.1, shear = 1.3, j = G.determinant();
            const degradation::Cubic g;
            const double             dil = K / 4. * (j * j - 1. - 2. * std::log(j));
            const double             dev = shear / 2. * ((G.transpose() * G).trace() / j - 2.);
            return g.value(phi) * dev + (j > 1. ? g.value(phi) : 1.) * dil;
          };
          for (const auto &density : body.assembler.densities(body.state.position, body.state.phase))
            CHECK(density.elastic == Approx(psi(F)).epsilon(1e-12));
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              {
                const double    h = 1e-5;
                Eigen::Matrix2d d = Eigen::Matrix2d::Zero();
                d(i, j)           = h;
                CHECK(P(i, j) == Approx((psi(F + d) - psi(F - d)) / (2. * h)).margin(1e-9));
              }
        }
}

TEST_CASE("Total force and moment of tractions and body forces are exact")
{
  // On a distorted patch with straight edges; traction linear along the edge, body force constant.
  for (const auto &mesh : meshes())
    {
      CAPTURE(mesh.name);
      const Body body(MPI_COMM_WORLD, mesh.surface);
      const auto X     = mesh.surface.control_points();
      const auto total = [&](const ControlValues<3> &f) {
        double moment = 0.;
        for (int i = 0; i < X.rows(); ++i)
          moment += X(i, 0) * f(i, 1) - X(i, 1) * f(i, 0);
        return Eigen::Vector3d(f.col(0).sum(), f.col(1).sum(), moment);
      };

      Loads<2> edge;
      edge.traction("right", [](const Point<2> &X, double time) { return Point<2>(time * (1. + X[1]), 2. * X[1]); });
      // int_0^4 at x = 4 of t = 5 (1 + y, .4 y): forces 5 (4 + 8), 16; moments 4 t_y - y t_x.
      const auto on_edge = body.loads(edge, 5.);
      CHECK((total(on_edge) - Eigen::Vector3d(60., 16., 64. - 5. * (8. + 64. / 3.))).norm() < 1e-12);
      CHECK(on_edge.col(2).norm() == 0.);
      const auto points = points_along(mesh.surface, mesh.surface.edge("right").front());
      for (int i = 0; i < X.rows(); ++i)
        if (std::find(points.begin(), points.end(), i) == points.end())
          CHECK(on_edge.row(i).norm() == 0.);

      Loads<2> weight;
      weight.surface_load([](const Point<2> &, double time) { return Point<2>(.5 * time, -3.); });
      // On the area 16 around (2, 2).
      CHECK((total(body.loads(weight, 2.)) - Eigen::Vector3d(16., -48., 2. * -48. - 2. * 16.)).norm() < 1e-12);

      // Loads add up.
      Loads<2> both = edge;
      both.surface_load(weight.surface_loads().front());
      CHECK((body.loads(both, 2.) - body.loads(edge, 2.) - body.loads(weight, 2.)).cwiseAbs().maxCoeff() < 1e-14);
    }
}

TEST_CASE("A traction on an unknown edge is refused")
{
  const Body body(MPI_COMM_WORLD, shapes::plate<2, 2>({1., 1.}, {2, 2}));
  Loads<2>   loads;
  loads.traction("lid", [](const Point<2> &, double) { return Point<2>(1., 0.); });
  CHECK_THROWS_AS(body.loads(loads), InvalidParameter);
}
