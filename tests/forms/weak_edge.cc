// label: unit
#include <catch2/catch.hpp>

#include <forms/loaded_surfaces.h>
#include <sherd/forms/weak_edge.h>
#include <sherd/verify/derivative.h>

using namespace sherd;
using namespace sherd::test;

namespace
{

PieceNormals<2> turned(const EdgeGeometry<2, 3> &piece, double angle)
{
  PieceNormals<2> target;
  for (int q = 0; q < 3; ++q)
    target[q] = turned_normal(piece, q, angle);
  return target;
}

Eigen::Map<const Eigen::VectorXd> flat(const ControlValues<3> &values)
{
  return {values.data(), values.size()};
}

/// One piece of each side of a plate of two by two elements, [0, 2] x [0, 1] in the plane z = 0.
std::vector<std::pair<std::string, EdgeGeometry<2, 3>>> sides(const Surface<2, 3> &surface)
{
  std::vector<std::pair<std::string, EdgeGeometry<2, 3>>> result;
  for (const auto &[name, edges] : surface.edges())
    result.push_back({name, edge_geometry(surface, edges.front()).front()});
  return result;
}

} // namespace

TEST_CASE("weak edges: forces and tangents derive from the energies")
{
  const auto     surface = curved_surface<2>(Shape::overloaded);
  const auto     X       = surface.control_points();
  const Point<3> e       = Point<3>(.3, -1., .4).normalized();
  for (const auto &[name, edges] : surface.edges())
    {
      const auto pieces = edge_geometry(surface, edges.front());
      const auto piece  = *std::max_element(
           pieces.begin(), pieces.end(), [](const auto &a, const auto &b) { return a.points.size() < b.points.size(); });
      const auto x      = disturbed(rows_of(X, piece.points), .05, 3);
      const auto dx     = disturbed(ControlValues<3>::Zero(x.rows(), 3), 1., 4);
      const auto target = turned(piece, .3);

      const auto path = [&](double h) { return ControlValues<3>(x + h * dx); };
      CHECK(verify::check_derivative([&](double h) { return held_normal_energy(piece, path(h), 2., target); },
                                     held_normal_force(piece, x, 2., target).cwiseProduct(dx).sum())
                .passed());
      const Eigen::VectorXd held = held_normal_tangent(piece, x, 2., target) * flat(dx);
      CHECK(verify::check_derivative(
                [&](double h) -> Eigen::VectorXd { return flat(held_normal_force(piece, path(h), 2., target)); }, held)
                .passed());
      CHECK(verify::check_derivative([&](double h) { return symmetry_energy(piece, path(h), 2., e); },
                                     symmetry_force(piece, x, 2., e).cwiseProduct(dx).sum())
                .passed());
      const Eigen::VectorXd symmetric = symmetry_tangent(piece, x, 2., e) * flat(dx);
      CHECK(verify::check_derivative(
                [&](double h) -> Eigen::VectorXd { return flat(symmetry_force(piece, path(h), 2., e)); }, symmetric)
                .passed());
    }
}

TEST_CASE("weak edges: the reference surface is free of force, and so is a turned one whose normals are held there")
{
  const auto surface = shapes::plate<2, 3>({2., 1.}, {2, 2});
  const auto X       = surface.control_points();
  for (const auto &[name, piece] : sides(surface))
    {
      const auto     x       = rows_of(X, piece.points);
      const auto    &point   = piece.quadrature[0];
      const Point<3> outward = turned_normal(piece, 0, M_PI / 2.); // the normal itself turned into the conormal
      const Point<3> inside  = x.colwise().mean().transpose();
      CHECK(outward.dot(point.position - inside) > 0.);
      CHECK(std::abs(outward[2]) <= 1e-15);
      CHECK(held_normal_force(piece, x, 1., turned(piece, 0.)).norm() <= 1e-14);
      CHECK(symmetry_force(piece, x, 1., outward).norm() <= 1e-14);

      // A rigid turn by an angle about the edge, which takes the normal towards the conormal: the outside goes down.
      const double           angle  = .4;
      const Point<3>         axis   = Point<3>::UnitZ().cross(outward);
      const Eigen::Matrix3d  R      = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const ControlValues<3> y      = x * R.transpose();
      double                 length = 0.;
      for (const auto &q : piece.quadrature)
        length += q.dS;
      CHECK(held_normal_force(piece, y, 1., turned(piece, angle)).norm() <= 1e-14);
      CHECK(held_normal_energy(piece, y, 3., turned(piece, 0.)) ==
            Approx(3. * (1. - std::cos(angle)) * length).epsilon(1e-12));
      CHECK(symmetry_energy(piece, y, 3., outward) ==
            Approx(1.5 * std::sin(angle) * std::sin(angle) * length).epsilon(1e-12));
    }
}

TEST_CASE("weak edges: the penalty of the phase is that of its slope across the edge")
{
  const auto surface = shapes::plate<2, 3>({2., 1.}, {2, 2});
  const auto X       = surface.control_points();
  for (const auto &[name, piece] : sides(surface))
    {
      const Eigen::VectorXd phi     = rows_of(X, piece.points) * Point<3>(.3, .7, 0.);
      const Point<3>        outward = turned_normal(piece, 0, M_PI / 2.);
      const double          slope   = outward.dot(Point<3>(.3, .7, 0.));
      double                length  = 0.;
      for (const auto &q : piece.quadrature)
        length += q.dS;
      CHECK(phi.dot(phase_symmetry_matrix(piece, {2., 2., 2.}) * phi) ==
            Approx(2. * slope * slope * length).epsilon(1e-12));
    }
}

TEST_CASE("weak edges: values that do not belong to the piece are refused")
{
  const auto             surface = shapes::plate<2, 3>({2., 1.}, {2, 2});
  const auto             piece   = sides(surface).front().second;
  const ControlValues<3> x       = surface.control_points().topRows(3);
  CHECK_THROWS_AS(held_normal_force(piece, x, 1., turned(piece, 0.)), DimensionMismatch);
  CHECK_THROWS_AS(symmetry_tangent(piece, x, 1., Point<3>::UnitX()), DimensionMismatch);
}
