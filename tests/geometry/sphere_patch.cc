// label: reference
#include <catch2/catch.hpp>
#include <yaml-cpp/yaml.h>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/place.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;
using shapes::Fit;

namespace
{

/// Largest ||X| - 1| over 11 x 11 points an element.
template <int degree>
double radius_error(const Surface<degree, 3> &surface)
{
  const auto &patch  = surface.patch(0);
  double      result = 0.;
  for (int e = 0; e < surface.n_elements(); ++e)
    {
      const auto X = bezier_element<3>(patch, e, patch.control_points);
      for (int k = 0; k < 121; ++k)
        result = std::max(result, std::abs(X(X.box.min[0] + X.box.size()[0] * (k % 11) / 10.,
                                             X.box.min[1] + X.box.size()[1] * (k / 11) / 10.)
                                               .norm() -
                                           1.));
    }
  return result;
}

} // namespace

TEST_CASE("One element of degree 4 is the published biquartic net")
{
  const auto net     = YAML::LoadFile(SHERD_TEST_DATA "/sphere_biquartic.json")["net_homogeneous"];
  const auto surface = shapes::sphere_patch<4>(1., {1, 1}, Fit::exact);
  const auto X       = surface.control_points();
  const auto w       = surface.weights();
  for (int j = 0, k = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i, ++k)
      {
        const auto c = net[i][j].as<std::vector<double>>();
        CHECK(w[k] == Approx(c[3]).epsilon(4e-14)); // rounding of 5 points interpolated
        for (int d = 0; d < 3; ++d)
          CHECK(w[k] * X(k, d) == Approx(c[d]).margin(1e-14));
      }
}

TEST_CASE("The patch of degree 4 is a sphere whose sides lie in planes through the edges of a cube")
{
  const auto surface = shapes::sphere_patch<4>(1., {3, 2}, Fit::exact);
  CHECK(radius_error(surface) < 1e-14);
  CHECK(radius_error(shapes::sphere_patch<4>(1., {3, 2}, Fit::rational)) < 1e-14);
  for (int k = 0; k <= 20; ++k)
    {
      const double u = 3. * k / 20., v = 2. * k / 20.;
      const auto   left = position(surface, {0, 0., v}), right = position(surface, {0, 3., v});
      const auto   bottom = position(surface, {0, u, 0.}), top = position(surface, {0, u, 2.});
      CHECK(std::abs(left[2] + left[0]) < 1e-14);
      CHECK(std::abs(right[2] - right[0]) < 1e-14);
      CHECK(std::abs(bottom[2] + bottom[1]) < 1e-14);
      CHECK(std::abs(top[2] - top[1]) < 1e-14);
    }
}

TEST_CASE("Radius errors of the quadratic patch are the published ones")
{
  struct Row
  {
    int    n;
    double polynomial, rational;
  };
  // theory I.2, two or three digits
  for (const Row &row :
       {Row{2, 2.8e-2, 1.05e-3}, Row{4, 2.0e-3, 8.2e-5}, Row{8, 1.3e-4, 8.6e-6}, Row{16, 1.2e-5, 9.4e-7}})
    {
      CHECK(radius_error(shapes::sphere_patch<2>(1., {row.n, row.n}, Fit::smooth)) ==
            Approx(row.polynomial).epsilon(.05));
      CHECK(radius_error(shapes::sphere_patch<2>(1., {row.n, row.n}, Fit::rational)) ==
            Approx(row.rational).epsilon(.05));
    }
}

TEST_CASE("Radius errors of the cubic patch fall with order 4 at least")
{
  for (const Fit fit : {Fit::rational, Fit::smooth})
    {
      const double coarse = radius_error(shapes::sphere_patch<3>(1., {4, 4}, fit));
      const double fine   = radius_error(shapes::sphere_patch<3>(1., {8, 8}, fit));
      CHECK(std::log2(coarse / fine) > 3.8);
    }
}
