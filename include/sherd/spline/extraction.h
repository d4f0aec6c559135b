#pragma once

#include <Eigen/Core>

#include <sherd/spline/bernstein.h>
#include <sherd/spline/lr_basis.h>

namespace sherd
{

/// Bernstein coefficients of the functions of one element, shape=(functions of the element, (degree+1)^2).
template <int degree>
using ExtractionMatrix = Eigen::Matrix<double, Eigen::Dynamic, (degree + 1) * (degree + 1), Eigen::RowMajor>;

/// Bezier extraction operator C of element @p e.  theory H.5
///
/// Row k holds the Bernstein coefficients of gamma_i B_i, i = basis.functions_of(e)[k], on the element; column
/// j (degree+1) + i belongs to the Bernstein polynomial with index i along u. C_i = gamma_i (e_u x e_v) with univariate
/// coefficients e. Columns sum to 1. A field with control data c has the Bernstein coefficients C^T c.
template <int degree>
ExtractionMatrix<degree> extraction(const LRBasis<degree> &basis, int e);

extern template ExtractionMatrix<2> extraction(const LRBasis<2> &, int);
extern template ExtractionMatrix<3> extraction(const LRBasis<3> &, int);
extern template ExtractionMatrix<4> extraction(const LRBasis<4> &, int);

} // namespace sherd
