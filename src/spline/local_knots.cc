#include <sherd/spline/local_knots.h>

#include <cassert>

namespace sherd
{

template <int degree>
int span_index(const LocalKnots<degree> &knots, double x)
{
  for (int m = 0; m <= degree; ++m)
    if (knots[m] <= x && x < knots[m + 1])
      return m;
  return -1;
}

template <int degree>
UnivariateValue evaluate_piece(const LocalKnots<degree> &knots, int m, double x)
{
  assert(0 <= m && m <= degree && knots[m] < knots[m + 1]);
  // n[k][i] is the B-spline of degree k on knots[i .. i+k+1]; those that vanish on the span stay zero.
  std::array<std::array<double, degree + 1>, degree + 1> n{};
  n[0][m] = 1.;
  for (int k = 1; k <= degree; ++k)
    for (int i = 0; i <= degree - k; ++i)
      {
        if (n[k - 1][i] != 0.)
          n[k][i] += (x - knots[i]) / (knots[i + k] - knots[i]) * n[k - 1][i];
        if (n[k - 1][i + 1] != 0.)
          n[k][i] += (knots[i + k + 1] - x) / (knots[i + k + 1] - knots[i + 1]) * n[k - 1][i + 1];
      }

  const auto scaled       = [&](int k, int i) { return n[k][i] == 0. ? 0. : n[k][i] / (knots[i + k + 1] - knots[i]); };
  const auto slope        = [&](int k, int i) { return k * (scaled(k - 1, i) - scaled(k - 1, i + 1)); };
  const auto scaled_slope = [&](int k, int i) {
    const double length = knots[i + k + 1] - knots[i];
    return length > 0. ? slope(k, i) / length : 0.;
  };
  return {n[degree][0], slope(degree, 0), degree * (scaled_slope(degree - 1, 0) - scaled_slope(degree - 1, 1))};
}

template <int degree>
std::array<double, degree + 1> bernstein_coefficients(const LocalKnots<degree> &knots, double a, double b)
{
  const int m = span_index<degree>(knots, a);
  if (m < 0)
    return {};
  assert(a < b && b <= knots[m + 1]);

  // Row i holds the coefficients of the B-spline of the current degree k on knots[i .. i+k+1].
  std::array<std::array<double, degree + 1>, degree + 1> n{};
  n[m][0] = 1.;
  for (int k = 1; k <= degree; ++k)
    {
      const int first = m > k ? m - k : 0, last = m < degree - k ? m : degree - k;
      for (int i = first; i <= last; ++i)
        {
          double rise_a = 0., rise_b = 0., fall_a = 0., fall_b = 0.; // linear factors at both ends
          if (i > m - k)
            {
              const double scale = 1. / (knots[i + k] - knots[i]);
              rise_a             = (a - knots[i]) * scale;
              rise_b             = (b - knots[i]) * scale;
            }
          if (i < m)
            {
              const double scale = 1. / (knots[i + k + 1] - knots[i + 1]);
              fall_a             = (knots[i + k + 1] - a) * scale;
              fall_b             = (knots[i + k + 1] - b) * scale;
            }
          // Linear times degree k-1: c_j = ((k-j) l_a d_j + j l_b d_{j-1}) / k; downwards, so in place.
          const auto lower = n[i], upper = i < degree ? n[i + 1] : std::array<double, degree + 1>{};
          n[i][0] = rise_a * lower[0] + fall_a * upper[0];
          for (int j = 1; j < k; ++j)
            n[i][j] = ((k - j) * (rise_a * lower[j] + fall_a * upper[j]) +
                       j * (rise_b * lower[j - 1] + fall_b * upper[j - 1])) /
                      k;
          n[i][k] = rise_b * lower[k - 1] + fall_b * upper[k - 1];
        }
    }
  return n[0];
}

template <int degree>
void insert_knots(const LocalKnots<degree> &knots, std::span<const double> inserted, KnotInsertion &result)
{
  result.knots.assign(knots.begin(), knots.end());
  result.weights.assign(1, 1.);
  auto &t = result.knots;
  auto &w = result.weights;
  for (const double x : inserted)
    {
      assert(knots.front() < x && x < knots.back());
      w.push_back(0.);
      // Window k gives to windows k and k+1 of the new knots; from the last to the first, so in place.
      for (std::size_t k = w.size() - 1; k-- > 0;)
        {
          const double *window = t.data() + k;
          const double  weight = w[k];
          const double  low = window[0], high = window[degree + 1];
          double        alpha_1 = 1., alpha_2 = 1.;
          if (x <= low)
            alpha_1 = 0.;
          else if (x < window[degree])
            alpha_1 = (x - low) / (window[degree] - low);
          if (x >= high)
            alpha_2 = 0.;
          else if (x > window[1])
            alpha_2 = (high - x) / (high - window[1]);
          w[k] = alpha_1 * weight;
          w[k + 1] += alpha_2 * weight;
        }
      std::size_t position = 0;
      while (t[position] <= x)
        ++position;
      t.insert(t.begin() + position, x);
    }
}

#define SHERD_INSTANTIATE(degree)                                                                                      \
  template int                            span_index<degree>(const LocalKnots<degree> &, double);                      \
  template UnivariateValue                evaluate_piece<degree>(const LocalKnots<degree> &, int, double);             \
  template std::array<double, degree + 1> bernstein_coefficients<degree>(const LocalKnots<degree> &, double, double);  \
  template void insert_knots<degree>(const LocalKnots<degree> &, std::span<const double>, KnotInsertion &);
SHERD_INSTANTIATE(2)
SHERD_INSTANTIATE(3)
SHERD_INSTANTIATE(4)
#undef SHERD_INSTANTIATE

} // namespace sherd
