// label: unit
#include <catch2/catch.hpp>

#include <geometry/sample_surfaces.h>
#include <sherd/geometry/shape_values.h>

using namespace sherd;

namespace
{

template <int degree>
void check_quotients()
{
  // S_b = B_b / W: the derivatives of the product S_b W are those of B_b.
  constexpr int         n = ShapeValues<degree>::n_functions;
  std::mt19937          random(13);
  std::array<double, n> W;
  for (double &w : W)
    w = 1. + .4 * test::symmetric(random);
  const auto &B       = polynomial_shape_values<degree>();
  const auto  S       = rational_shape_values<degree>(W);
  double      largest = 0.;
  for (int q = 0; q < S.n_points; ++q)
    {
      double w = 0., w1 = 0., w2 = 0., w11 = 0., w22 = 0., w12 = 0., sum = 0.;
      for (int b = 0; b < n; ++b)
        {
          w += W[b] * B.value[q][b];
          w1 += W[b] * B.d1[q][b];
          w2 += W[b] * B.d2[q][b];
          w11 += W[b] * B.d11[q][b];
          w22 += W[b] * B.d22[q][b];
          w12 += W[b] * B.d12[q][b];
          sum += W[b] * S.value[q][b];
        }
      CHECK(sum == Approx(1.).epsilon(1e-14));
      for (int b = 0; b < n; ++b)
        {
          const double s = S.value[q][b], s1 = S.d1[q][b], s2 = S.d2[q][b];
          for (const double defect : {s * w - B.value[q][b], s1 * w + s * w1 - B.d1[q][b], s2 * w + s * w2 - B.d2[q][b],
                                      S.d11[q][b] * w + 2. * s1 * w1 + s * w11 - B.d11[q][b],
                                      S.d22[q][b] * w + 2. * s2 * w2 + s * w22 - B.d22[q][b],
                                      S.d12[q][b] * w + s1 * w2 + s2 * w1 + s * w12 - B.d12[q][b]})
            largest = std::max(largest, std::abs(defect));
        }
    }
  CHECK(largest < 1e-13); // second derivatives reach degree^2
}

} // namespace

TEST_CASE("Rational shape functions follow the quotient rule")
{
  check_quotients<2>();
  check_quotients<3>();
  check_quotients<4>();
}

TEST_CASE("Equal weights give the polynomial shape functions")
{
  std::array<double, 9> W;
  W.fill(2.);
  const auto  S       = rational_shape_values<2>(W);
  const auto &B       = polynomial_shape_values<2>();
  double      largest = 0.;
  for (int q = 0; q < 9; ++q)
    for (int b = 0; b < 9; ++b)
      for (const double defect :
           {2. * S.value[q][b] - B.value[q][b], 2. * S.d1[q][b] - B.d1[q][b], 2. * S.d2[q][b] - B.d2[q][b],
            2. * S.d11[q][b] - B.d11[q][b], 2. * S.d22[q][b] - B.d22[q][b], 2. * S.d12[q][b] - B.d12[q][b]})
        largest = std::max(largest, std::abs(defect));
  CHECK(largest < 1e-14);
}
