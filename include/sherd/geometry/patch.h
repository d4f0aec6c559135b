#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/types.h>
#include <sherd/spline/lr_basis.h>

namespace sherd
{

/// Sides of the parameter rectangle of a patch.
enum class Side
{
  u_min,
  u_max,
  v_min,
  v_max
};

/// LR NURBS patch of the reference surface, X = sum_i w_i gamma_i B_i X_i / sum_i w_i gamma_i B_i.
///
/// Control points and weights are in the order of the functions of the basis.
///
/// Source: theory H.1, H.5.
template <int degree, int spacedim>
struct Patch
{
  LRBasis<degree>         basis;
  ControlValues<spacedim> control_points; ///< X_i, shape=(n_functions, spacedim)
  Eigen::VectorXd         weights;        ///< w_i > 0, shape=(n_functions)
};

/// Throws DimensionMismatch or InvalidParameter unless the arrays fit the basis and all weights are positive.
template <int degree, int spacedim>
void validate(const Patch<degree, spacedim> &patch)
{
  const auto n = patch.basis.n_functions();
  if (patch.control_points.rows() != n || patch.weights.size() != n)
    throw DimensionMismatch("patch: " + std::to_string(n) + " basis functions, but " +
                            std::to_string(patch.control_points.rows()) + " control points and " +
                            std::to_string(patch.weights.size()) + " weights; expected one of each a function");
  if (!(patch.weights.array() > 0.).all())
    throw InvalidParameter("patch: a weight is not positive; rational weights must be larger than 0");
}

/// Turns a transfer of homogeneous coefficients w c into one of values c: row i of the result is T_ij w_j / w'_i with
/// w' = T w. Also replaces @p weights by w'. Equal weights stay the same number, so that a polynomial patch stays one.
inline SparseTransfer rational_transfer(SparseTransfer homogeneous, Eigen::VectorXd &weights)
{
  if ((weights.array() == weights[0]).all())
    {
      weights = Eigen::VectorXd::Constant(homogeneous.n_rows(), weights[0]);
      return homogeneous;
    }
  const Eigen::VectorXd old     = weights;
  Eigen::VectorXd       refined = Eigen::VectorXd::Zero(homogeneous.n_rows());
  for (int i = 0; i < homogeneous.n_rows(); ++i)
    for (int k = homogeneous.offsets[i]; k < homogeneous.offsets[i + 1]; ++k)
      refined[i] += homogeneous.values[k] * old[homogeneous.columns[k]];
  for (int i = 0; i < homogeneous.n_rows(); ++i)
    for (int k = homogeneous.offsets[i]; k < homogeneous.offsets[i + 1]; ++k)
      homogeneous.values[k] *= old[homogeneous.columns[k]] / refined[i];
  weights = std::move(refined);
  return homogeneous;
}

} // namespace sherd
