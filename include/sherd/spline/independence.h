#pragma once

#include <vector>

#include <sherd/spline/lr_basis.h>

namespace sherd
{

/// Result of check_independence().
struct Independence
{
  std::vector<int> overloaded_elements;  ///< elements with more than (degree+1)^2 functions; normal after refinement
  std::vector<int> overloaded_functions; ///< functions all of whose elements are overloaded
  std::vector<int> left_after_peeling;   ///< those that peeling does not prove independent of the others
  std::vector<int> dependent;            ///< functions that take part in a linear dependence; empty if independent

  bool independent() const { return dependent.empty(); }
};

/// Decides whether the functions of @p basis are linearly independent.  theory H.5
///
/// Only overloaded functions can take part in a dependence. Peeling removes those that are the only remaining candidate
/// on some overloaded element, until none is left or none can be removed. What is left is decided by the rank of its
/// Bernstein coefficients, one connected group of functions at a time; the cost of that is cubic in the group, and
/// groups are empty or small in practice.
template <int degree>
Independence check_independence(const LRBasis<degree> &basis);

extern template Independence check_independence(const LRBasis<2> &);
extern template Independence check_independence(const LRBasis<3> &);
extern template Independence check_independence(const LRBasis<4> &);

} // namespace sherd
