#pragma once

#include <numeric>

#include <sherd/geometry/patch.h>
#include <sherd/spline/bernstein.h>
#include <sherd/spline/extraction.h>

namespace sherd
{

/// Fields with n components on one element in rational Bezier form, f = sum_b W_b f_b B_b / sum_b W_b B_b with the
/// Bernstein polynomials of the element, b = j (degree+1) + i with i along u.  theory H.5
template <int degree, int n>
struct BezierElement
{
  static constexpr int n_b = n_bernstein<degree>;
  using Weights            = Eigen::Matrix<double, n_b, 1>;
  using Values             = Eigen::Matrix<double, n_b, n>;

  Box     box;     ///< the element in the parameters of its patch
  Weights weights; ///< W_b
  Values  values;  ///< f_b, shape=(n_b, n)

  /// f at parameters (@p u, @p v) of the patch.
  Eigen::Matrix<double, n, 1> operator()(double u, double v) const
  {
    const auto    size = box.size();
    const auto    B    = bernstein_2d<degree>((u - box.min[0]) / size[0], (v - box.min[1]) / size[1]).value;
    const Weights w    = weights.cwiseProduct(Eigen::Map<const Weights>(B.data()));
    return values.transpose() * w / std::accumulate(w.begin(), w.end(), 0.);
  }
};

/// Element @p e of a patch with the fields of @p control_values, shape=(n_functions of the patch, n).
template <int n, int degree, int spacedim, class Derived>
BezierElement<degree, n> bezier_element(const Patch<degree, spacedim> &patch, int e,
                                        const Eigen::MatrixBase<Derived> &control_values)
{
  using Element                       = BezierElement<degree, n>;
  const auto                C         = extraction(patch.basis, e);
  const auto                functions = patch.basis.functions_of(e);
  typename Element::Weights W         = Element::Weights::Zero();
  typename Element::Values  H         = Element::Values::Zero();
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      const typename Element::Weights w = patch.weights[functions[k]] * C.row(k).transpose();
      W += w;
      H.noalias() += w * control_values.row(functions[k]);
    }
  return {patch.basis.element(e), W, W.cwiseInverse().asDiagonal() * H};
}

} // namespace sherd
