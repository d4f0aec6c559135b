#include <sherd/geometry/interpolate.h>

#include <algorithm>

namespace sherd
{
namespace
{

/// Replaces @p values, shape=(n, any), by the coefficients of the univariate spline with these values at the Greville
/// points.
///
/// The matrix N_i(x_k) is totally positive and banded, so that elimination needs no pivots.
template <int degree>
void solve_univariate(const std::vector<double> &knots, Eigen::Ref<Eigen::MatrixXd> values)
{
  const auto      points = greville_points<degree>(knots);
  const int       n      = static_cast<int>(points.size());
  Eigen::MatrixXd band   = Eigen::MatrixXd::Zero(n, 2 * degree + 1);
  const auto      entry  = [&](int k, int i) -> double       &{ return band(k, i - k + degree); };
  for (int i = 0; i < n; ++i)
    {
      LocalKnots<degree> local;
      std::copy_n(knots.begin() + i, degree + 2, local.begin());
      for (int k = std::max(0, i - degree); k <= std::min(n - 1, i + degree); ++k)
        if (const int span = span_index<degree>(local, points[k]); span >= 0)
          entry(k, i) = evaluate_piece<degree>(local, span, points[k]).value;
    }
  entry(n - 1, n - 1) = 1.; // supports are half-open, the domain is closed

  for (int k = 0; k < n; ++k)
    for (int r = k + 1; r <= std::min(n - 1, k + degree); ++r)
      {
        const double factor = entry(r, k) / entry(k, k);
        for (int i = k; i <= std::min(n - 1, k + degree); ++i)
          entry(r, i) -= factor * entry(k, i);
        values.row(r) -= factor * values.row(k);
      }
  for (int k = n - 1; k >= 0; --k)
    {
      for (int i = k + 1; i <= std::min(n - 1, k + degree); ++i)
        values.row(k) -= entry(k, i) * values.row(i);
      values.row(k) /= entry(k, k);
    }
}

} // namespace

template <int degree>
std::vector<double> greville_points(const std::vector<double> &knots)
{
  std::vector<double> points;
  for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i)
    {
      double sum = 0.;
      for (int k = 1; k <= degree; ++k)
        sum += knots[i + k];
      // Rounding must not move the point of a repeated knot off it.
      points.push_back(knots[i + 1] == knots[i + degree] ? knots[i + 1] : sum / degree);
    }
  return points;
}

template <int degree>
Eigen::MatrixXd interpolation_coefficients(const std::vector<double> &knots_u, const std::vector<double> &knots_v,
                                           const Eigen::MatrixXd &values)
{
  const auto n_u = static_cast<Eigen::Index>(knots_u.size()) - degree - 1;
  const auto n_v = static_cast<Eigen::Index>(knots_v.size()) - degree - 1;
  if (n_u < 1 || n_v < 1 || values.rows() != n_u * n_v)
    throw DimensionMismatch("interpolation: " + std::to_string(values.rows()) + " rows of values, but the knots have " +
                            std::to_string(n_u) + " x " + std::to_string(n_v) + " Greville points");
  // One column a component, its rows run along u first: shape=(n_u, n_v) for each component, side by side.
  Eigen::MatrixXd c = values.reshaped(n_u, n_v * values.cols());
  solve_univariate<degree>(knots_u, c);
  for (Eigen::Index component = 0; component < values.cols(); ++component)
    {
      Eigen::MatrixXd transposed = c.middleCols(component * n_v, n_v).transpose();
      solve_univariate<degree>(knots_v, transposed);
      c.middleCols(component * n_v, n_v) = transposed.transpose();
    }
  return c.reshaped(n_u * n_v, values.cols());
}

#define SHERD_INSTANTIATE(degree)                                                                                      \
  template std::vector<double> greville_points<degree>(const std::vector<double> &);                                   \
  template Eigen::MatrixXd     interpolation_coefficients<degree>(const std::vector<double> &,                         \
                                                              const std::vector<double> &, const Eigen::MatrixXd &);
SHERD_INSTANTIATE(2)
SHERD_INSTANTIATE(3)
SHERD_INSTANTIATE(4)
#undef SHERD_INSTANTIATE

} // namespace sherd
