#pragma once

#include <array>
#include <span>
#include <vector>

#include <sherd/spline/lr_basis.h>

namespace sherd
{

/// gamma_i B_i and its derivatives at one point.
struct FunctionValue
{
  double                value;
  std::array<double, 2> first;  ///< d/du, d/dv
  std::array<double, 3> second; ///< d2/du2, d2/dv2, d2/dudv
};

/// gamma_i B_i of all functions of element @p e at (@p u, @p v), in the order of basis.functions_of(e), by the
/// recurrence of Cox and de Boor. Evaluates the polynomial pieces of that element; the point may lie on its edges.
template <int degree>
std::vector<FunctionValue> evaluate(const LRBasis<degree> &basis, int e, double u, double v);

extern template std::vector<FunctionValue> evaluate(const LRBasis<2> &, int, double, double);
extern template std::vector<FunctionValue> evaluate(const LRBasis<3> &, int, double, double);
extern template std::vector<FunctionValue> evaluate(const LRBasis<4> &, int, double, double);

} // namespace sherd
