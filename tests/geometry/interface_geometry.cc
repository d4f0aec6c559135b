// label: unit
#include <catch2/catch.hpp>

#include <geometry/joined_surfaces.h>
#include <sherd/geometry/interface_geometry.h>

using namespace sherd;

namespace
{

/// sum_A values_A X_A over the control points of one side.
template <int degree, int spacedim>
Point<spacedim> combine(const Surface<degree, spacedim> &surface, const std::vector<int> &points,
                        const std::vector<double> &values)
{
  const auto      X   = surface.control_points();
  Point<spacedim> sum = Point<spacedim>::Zero();
  for (std::size_t k = 0; k < points.size(); ++k)
    sum += values[k] * X.row(points[k]).transpose();
  return sum;
}

template <int degree, int spacedim>
void refine_some(Surface<degree, spacedim> &surface, int levels, std::mt19937 &random)
{
  for (int level = 1; level <= levels; ++level)
    {
      std::vector<int> marked;
      for (int k = 0; k < 4; ++k)
        marked.push_back(static_cast<int>(random() % surface.n_control_points()));
      surface.refine_to(marked, test::halved(surface, level));
    }
}

/// What holds on any interface, seen from both sides.
template <int degree, int spacedim>
void check_geometry(const Surface<degree, spacedim> &surface)
{
  for (int k = 0; k < static_cast<int>(surface.interfaces().size()); ++k)
    {
      const auto &[first, second, reversed] = surface.interfaces()[k];
      const auto                pieces      = interface_geometry(surface, k);
      const std::array<Edge, 2> edges{first, second};
      std::array<double, 2>     reached;
      for (int s = 0; s < 2; ++s)
        {
          const auto &domain = surface.patch(edges[s].patch).basis.domain();
          const int   along  = 1 - internal::normal_direction(edges[s].side);
          reached[s]         = s == 1 && reversed ? domain.max[along] : domain.min[along];
        }
      for (const auto &piece : pieces)
        {
          CHECK(piece.piece.interface == k);
          for (int s = 0; s < 2; ++s)
            {
              // The pieces follow each other, each inside its elements.
              const auto &side         = piece.sides[s];
              const auto &[start, end] = piece.piece.range[s];
              const auto [p, local]    = surface.locate_element(side.element);
              const auto &box          = surface.patch(p).basis.element(local);
              const int   along        = 1 - side.normal_direction;
              CHECK(p == edges[s].patch);
              CHECK(side.element == piece.piece.elements[s]);
              CHECK(side.normal_direction == internal::normal_direction(edges[s].side));
              CHECK(start == reached[s]);
              CHECK(box.min[along] <= std::min(start, end));
              CHECK(std::max(start, end) <= box.max[along]);
              reached[s] = end;
            }
          for (const auto &q : piece.quadrature)
            for (int s = 0; s < 2; ++s)
              {
                const auto           &side  = piece.sides[s];
                const auto           &point = q.side[s];
                const Point<spacedim> A1 = point.A1, A2 = point.A2;
                CHECK((combine(surface, side.points, point.value) - q.position).norm() < 1e-14);
                CHECK((combine(surface, side.points, point.d1) - A1).norm() < 1e-13);
                CHECK((combine(surface, side.points, point.d2) - A2).norm() < 1e-13);
                const Point<spacedim> along = (side.normal_direction == 0 ? A2 : A1).normalized();
                CHECK((along - (s == 1 && reversed ? -1. : 1.) * q.tangent).norm() < 1e-12);
                // A unit vector normal to the interface, in the tangent plane, that leaves the element.
                const Point<spacedim> nu = point.conormal[0] * A1 + point.conormal[1] * A2;
                CHECK(nu.norm() == Approx(1.).epsilon(1e-12));
                CHECK(std::abs(nu.dot(q.tangent)) < 1e-12);
                CHECK(side.outward * nu.dot(side.normal_direction == 0 ? A1 : A2) ==
                      Approx(point.height).epsilon(1e-12));
                CHECK(point.height > 0.);
              }
        }
      for (int s = 0; s < 2; ++s)
        {
          const auto &domain = surface.patch(edges[s].patch).basis.domain();
          const int   along  = 1 - internal::normal_direction(edges[s].side);
          CHECK(reached[s] == (s == 1 && reversed ? domain.min[along] : domain.max[along]));
        }
    }
}

} // namespace

TEST_CASE("Both sides of an interface see the same curve, after any refinement")
{
  std::mt19937 random(8);
  SECTION("flat patches around a corner")
  {
    const int     n       = GENERATE(2, 3, 5);
    const auto    patches = test::star<2, 3>(n, 3, random);
    Surface<2, 3> surface(patches, {}, find_interfaces(patches));
    refine_some(surface, 3, random);
    check_geometry(surface);
    for (std::size_t k = 0; k < surface.interfaces().size(); ++k)
      {
        double length = 0.;
        for (const auto &piece : interface_geometry(surface, static_cast<int>(k)))
          {
            length += piece.length();
            for (const auto &q : piece.quadrature)
              {
                // In a plane the conormals are opposite.
                std::array<Eigen::Vector3d, 2> nu;
                for (int s = 0; s < 2; ++s)
                  nu[s] = q.side[s].conormal[0] * q.side[s].A1 + q.side[s].conormal[1] * q.side[s].A2;
                CHECK((nu[0] + nu[1]).norm() < 1e-12);
              }
          }
        CHECK(length == Approx(1.).epsilon(1e-13)); // a straight side
      }
  }
  SECTION("a closed rational surface")
  {
    const auto    patches = test::ball<2>(3, random);
    Surface<2, 3> surface(patches, {}, find_interfaces(patches));
    refine_some(surface, 2, random);
    check_geometry(surface);
  }
  SECTION("a strip joined to itself with a half turn")
  {
    const auto    patch = test::closed_patch<2>(test::Closed::moebius, 6, 4);
    Surface<2, 3> surface({patch}, {}, find_interfaces(std::vector{patch}));
    refine_some(surface, 2, random);
    check_geometry(surface);
  }
}

TEST_CASE("Elements of rectangles are as high as they are wide across the interface")
{
  const auto left  = test::bilinear<2, 2>({Point<2>(0., 0.), Point<2>(3., 0.), Point<2>(0., 1.), Point<2>(3., 1.)},
                                         test::equal_knots<2>(2, 0., 1.), test::equal_knots<2>(4, 0., 1.));
  const auto right = test::bilinear<2, 2>({Point<2>(3., 0.), Point<2>(4., 0.), Point<2>(3., 1.), Point<2>(4., 1.)},
                                          test::equal_knots<2>(5, 0., 1.), test::equal_knots<2>(4, 0., 7.));
  const Surface<2, 2> surface({left, right}, {}, {{{0, Side::u_max}, {1, Side::u_min}, false}});
  const auto          pieces = interface_geometry(surface, 0);
  REQUIRE(pieces.size() == 4);
  CHECK(interface_pieces(surface).size() == 4);
  for (const auto &piece : pieces)
    {
      CHECK(piece.length() == Approx(.25));
      for (const auto &q : piece.quadrature)
        {
          CHECK(q.position[0] == Approx(3.));
          CHECK(q.side[0].height == Approx(1.5));
          CHECK(q.side[1].height == Approx(.2));
        }
    }
}
