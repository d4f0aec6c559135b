// label: reference
#include <set>

#include <catch2/catch.hpp>
#include <yaml-cpp/yaml.h>

#include <geometry/patch_samples.h>
#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;
using shapes::Fit;

namespace
{

const char *face_names[] = {"+z", "-z", "+x", "+y", "-x", "-y"};

/// Largest ||X| - 1| over 11 x 11 points an element.
template <int degree>
double radius_error(const Surface<degree, 3> &surface)
{
  double result = 0.;
  for (int p = 0; p < surface.n_patches(); ++p)
    for (int e = 0; e < surface.patch(p).basis.n_elements(); ++e)
      {
        const auto X = bezier_element<3>(surface.patch(p), e, surface.patch(p).control_points);
        for (int k = 0; k < 121; ++k)
          result = std::max(result, std::abs(X(X.box.min[0] + X.box.size()[0] * (k % 11) / 10.,
                                               X.box.min[1] + X.box.size()[1] * (k / 11) / 10.)
                                                 .norm() -
                                             1.));
      }
  return result;
}

std::string side_name(Side side)
{
  return side == Side::u_min ? "u0" : side == Side::u_max ? "u1" : side == Side::v_min ? "v0" : "v1";
}

double degrees(double radians)
{
  return radians * 180. / M_PI;
}

} // namespace

TEST_CASE("Six biquartic patches of one element are the published nets, in the published rotations")
{
  const auto data   = YAML::LoadFile(SHERD_TEST_DATA "/sphere_biquartic.json");
  const auto sphere = shapes::sphere<4>(1., 1);
  REQUIRE(sphere.n_patches() == 6);
  for (int p = 0; p < 6; ++p)
    {
      const auto      rotation = data["rotations"][face_names[p]].as<std::vector<std::vector<double>>>();
      Eigen::Matrix3d R;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          R(a, b) = rotation[a][b];
      for (int j = 0, k = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i, ++k)
          {
            const auto            c = data["net_homogeneous"][i][j].as<std::vector<double>>();
            const double          w = sphere.patch(p).weights[k];
            const Eigen::Vector3d X = sphere.patch(p).control_points.row(k);
            CHECK(w == Approx(c[3]).epsilon(4e-14)); // rounding of 5 points interpolated
            CHECK((w * X - R * Eigen::Vector3d(c[0], c[1], c[2])).norm() < 2e-14);
          }
    }

  // The published pairs of sides, and which of them run against each other.
  std::set<std::string> found, published;
  const auto            entry = [](const std::string &a, const std::string &b, const std::string &orientation) {
    return std::min(a, b) + " " + std::max(a, b) + " " + orientation;
  };
  for (const auto &pair : data["edge_pairs"])
    {
      const auto s = pair.as<std::vector<std::string>>();
      published.insert(entry(s[0] + s[1], s[2] + s[3], s[4]));
    }
  for (const auto &joined : sphere.interfaces())
    {
      found.insert(entry(face_names[joined.first.patch] + side_name(joined.first.side),
                         face_names[joined.second.patch] + side_name(joined.second.side),
                         joined.reversed ? "reversed" : "same"));
      CHECK(normals_agree(joined));
    }
  CHECK(found == published);
}

TEST_CASE("The sphere of degree 4 is exact: radius, area, no kink, normals outward")
{
  const auto sphere = shapes::sphere<4>(1., 4);
  CHECK(radius_error(sphere) < 1e-14);
  CHECK(test::kinks(sphere)[1] < 1e-7);
  CHECK(test::largest_gap(sphere) < 1e-14);
  CHECK(test::area(sphere) == Approx(4. * M_PI).epsilon(1e-12));
  CHECK(sphere.edges().empty());
  CHECK(test::n_free_sides(sphere) == 0);
  // 6 faces of 8 x 8 points with 12 edges and 8 corners shared.
  CHECK(sphere.n_control_points() == 6 * 36 + 12 * 6 + 8);
  for (int p = 0; p < 6; ++p)
    for (const double u : {0., 1.3, 4.})
      for (const double v : {0., 2.2, 4.})
        CHECK((test::normal_at(sphere.patch(p), u, v) - test::position_at(sphere.patch(p), u, v)).norm() < 1e-12);
}

TEST_CASE("Radius errors and kinks of the quadratic sphere are the published ones")
{
  struct Row
  {
    int    n;
    double polynomial, polynomial_kink, rational, rational_kink; // kinks in degrees
  };
  // theory I.2, two or three digits
  for (const Row &row : {Row{2, 2.8e-2, 3.99, 1.05e-3, .563}, Row{4, 2.0e-3, 1.70, 8.2e-5, .180},
                         Row{8, 1.3e-4, .456, 8.6e-6, .053}, Row{16, 1.2e-5, .117, 9.4e-7, .0142}})
    {
      const auto rational = shapes::sphere<2>(1., row.n), smooth = shapes::sphere<2>(1., row.n, Fit::smooth);
      CHECK(radius_error(rational) == Approx(row.rational).epsilon(.05));
      CHECK(radius_error(smooth) == Approx(row.polynomial).epsilon(.05));
      CHECK(degrees(test::kinks(rational)[1]) == Approx(row.rational_kink).epsilon(.02));
      CHECK(degrees(test::kinks(smooth)[1]) == Approx(row.polynomial_kink).epsilon(.02));
      CHECK(test::largest_gap(rational) < 1e-14);
      CHECK(test::n_free_sides(rational) == 0);
    }
}

TEST_CASE("Radius errors and kinks of the cubic sphere are those of its description, of order 4 and 3")
{
  struct Row
  {
    int    n;
    double radius, kink; // kink in degrees
  };
  for (const Row &row : {Row{2, 9.4e-5, .326}, Row{4, 1.5e-5, .0362}, Row{8, 9.4e-7, .00448}, Row{16, 8.0e-8, .00056}})
    {
      const auto sphere = shapes::sphere<3>(1., row.n);
      CHECK(radius_error(sphere) == Approx(row.radius).epsilon(.05));
      CHECK(degrees(test::kinks(sphere)[1]) == Approx(row.kink).epsilon(.02));
    }
  const auto coarse = shapes::sphere<3>(1., 8), fine = shapes::sphere<3>(1., 16);
  CHECK(std::log2(radius_error(coarse) / radius_error(fine)) > 3.5);
  CHECK(std::log2(test::kinks(coarse)[1] / test::kinks(fine)[1]) > 2.9);
}

TEST_CASE("A rotation turns the whole sphere and changes nothing else")
{
  const Eigen::Matrix3d R     = (Eigen::AngleAxisd(.7, Eigen::Vector3d(1., 2., 3.).normalized())).toRotationMatrix();
  const auto            plain = shapes::sphere<2>(2., 4), turned = shapes::sphere<2>(2., 4, Fit::rational, R);
  CHECK(turned.interfaces().size() == 12);
  CHECK(turned.weights() == plain.weights());
  CHECK((turned.control_points() - plain.control_points() * R.transpose()).cwiseAbs().maxCoeff() < 1e-14);

  CHECK_THROWS_WITH(shapes::sphere<2>(1., 2, Fit::rational, -Eigen::Matrix3d::Identity()),
                    Catch::Contains("reflection"));
  CHECK_THROWS_WITH(shapes::sphere<2>(1., 2, Fit::rational, 1.1 * R), Catch::Contains("orthogonal"));
  CHECK_THROWS_AS(shapes::sphere<2>(1., 2, Fit::exact), InvalidParameter);
  CHECK_THROWS_AS(shapes::sphere<2>(0., 2), InvalidParameter);
  CHECK_THROWS_AS(shapes::sphere<2>(1., 0), InvalidParameter);
}

TEST_CASE("The hemisphere is the upper half of the sphere, its rim the equator")
{
  const auto check = [](const auto &hemisphere, double radius_tolerance) {
    CHECK(hemisphere.n_patches() == 5);
    CHECK(hemisphere.interfaces().size() == 8);
    REQUIRE(hemisphere.edge("equator").size() == 4);
    CHECK(test::n_free_sides(hemisphere) == 4);
    for (const auto &edge : hemisphere.edge("equator"))
      for (const int i : points_along(hemisphere, edge))
        CHECK(std::abs(hemisphere.control_points()(i, 2)) < 1e-15);
    CHECK(hemisphere.control_points().col(2).minCoeff() > -1e-15);
    CHECK(radius_error(hemisphere) < radius_tolerance);
    CHECK(test::area(hemisphere) == Approx(2. * M_PI).epsilon(10. * radius_tolerance));
  };
  check(shapes::hemisphere<4>(1., 4), 1e-13);
  check(shapes::hemisphere<2>(1., 8), 9e-6);
  CHECK_THROWS_WITH(shapes::hemisphere<2>(1., 3), Catch::Contains("even"));
}
