#pragma once

#include <vector>

#include <sherd/space/supports.h>

namespace sherd
{

/// One control value that follows others: c_point = sum_k factors[k] c_masters[k], for the displacement u = x - X or
/// the phase. Linear and homogeneous, so that increments, rates and values obey the same tie.
struct Tie
{
  int                 point;   ///< surface numbering
  int                 field;   ///< displacement component, or spacedim for the phase
  std::vector<int>    masters; ///< surface numbering, ascending
  std::vector<double> factors; ///< positive, sum 1, shape=(n_masters)
};

/// Ties of @p field under which its derivative across @p edge vanishes on the whole edge: first row from second row.
///
/// Across the edge only the functions of the first row (knots repeat the border degree + 1 times, first span h_i) and
/// of the second row (degree times, first span a_j) have a slope. Write N for their parts along the edge, w for the
/// rational weights, p for the degree. With the denominator's slope W' = kappa W, kappa constant along the edge, the
/// slope of sum_i c_i R_i vanishes where
///
///     sum_first (p / h_i + kappa) w_i gamma_i N_i c_i = sum_second (p / a_j) w_j gamma_j N_j c_j .
///
/// Every line that splits a second-row function splits those of the first row under it too, so each N_j = sum_i beta_ij
/// N_i with beta_ij >= 0 by knot insertion. Comparing coefficients gives c_i as a mean of those c_j with beta_ij > 0:
/// exact everywhere on the edge, and the support of a master contains that of its slave. On a tensor mesh it is one
/// master with the factor 1. kappa is 0 for polynomials, and constant for all surfaces of revolution and translation.
/// Source: theory G.5, H.2.
/// @throws Error   the slope cannot vanish on the whole edge with these functions: W' / W varies along the edge, or
///                 functions are linearly dependent on it
template <int degree, int spacedim>
std::vector<Tie> level_ties(const Surface<degree, spacedim> &surface, const Edge &edge, int field);

/// Ties of all symmetric edges, resolved: no master is tied itself, no (point, field) is tied twice, none that a
/// support holds is tied. The support of each master contains that of its slave, so that a slave's elements list its
/// masters.
/// @throws InvalidParameter   unknown edge or component; a symmetric edge that is not in a plane of this normal, or
///                            that parameter lines cross more than 3 degrees off the right angle
/// @throws Error              from level_ties; ties that contradict or need each other where symmetric edges meet
template <int degree, int spacedim>
std::vector<Tie> ties(const Supports &supports, const Surface<degree, spacedim> &surface);

/// Replaces tied masters by their own masters. Ties of held unknowns are left out. Of several ties for one unknown the
/// first is kept; the others have to say the same.
/// @param held   1 for each unknown that a support holds, entry point * n_fields + field
/// @throws Error   ties that need each other in a circle, or that contradict
std::vector<Tie> resolve(const std::vector<Tie> &ties, const std::vector<char> &held, int n_fields);

} // namespace sherd

#include <sherd/space/ties.templates.h>
