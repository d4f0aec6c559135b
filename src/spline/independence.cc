#include <sherd/spline/independence.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include <Eigen/Core>

#include <sherd/spline/extraction.h>

namespace sherd
{

namespace
{

template <int degree>
bool is_overloaded(const LRBasis<degree> &basis, int e)
{
  return static_cast<int>(basis.functions_of(e).size()) > n_bernstein<degree>;
}

/// Functions that stay when those that are the only candidate on some overloaded element are removed one by one.
template <int degree>
std::vector<int> peel(const LRBasis<degree> &basis, const std::vector<int> &overloaded_functions)
{
  std::vector<char> is_candidate(basis.n_functions(), 0);
  std::vector<int>  n_candidates(basis.n_elements(), 0), single;
  for (const int i : overloaded_functions)
    {
      is_candidate[i] = 1;
      for (const int e : basis.elements_of(i))
        ++n_candidates[e];
    }
  for (int e = 0; e < basis.n_elements(); ++e)
    if (n_candidates[e] == 1)
      single.push_back(e);
  while (!single.empty())
    {
      const int e = single.back();
      single.pop_back();
      for (const int i : basis.functions_of(e))
        if (is_candidate[i])
          {
            is_candidate[i] = 0;
            for (const int other : basis.elements_of(i))
              if (--n_candidates[other] == 1)
                single.push_back(other);
          }
    }
  std::vector<int> left;
  std::copy_if(overloaded_functions.begin(), overloaded_functions.end(), std::back_inserter(left),
               [&](int i) { return is_candidate[i] != 0; });
  return left;
}

/// Groups of functions connected through common elements.
template <int degree>
std::vector<std::vector<int>> connected_groups(const LRBasis<degree> &basis, const std::vector<int> &functions)
{
  std::vector<char> open(basis.n_functions(), 0);
  for (const int i : functions)
    open[i] = 1;
  std::vector<std::vector<int>> groups;
  for (const int seed : functions)
    {
      if (!open[seed])
        continue;
      std::vector<int> group{seed};
      open[seed] = 0;
      for (std::size_t k = 0; k < group.size(); ++k)
        for (const int e : basis.elements_of(group[k]))
          for (const int i : basis.functions_of(e))
            if (open[i])
              {
                open[i] = 0;
                group.push_back(i);
              }
      groups.push_back(std::move(group));
    }
  return groups;
}

/// Products A^T A, where the columns of A are the Bernstein coefficients of the functions of the group on all their
/// elements, scaled to length 1.
template <int degree>
Eigen::MatrixXd gram_matrix(const LRBasis<degree> &basis, const std::vector<int> &group)
{
  std::map<int, int> member;
  std::set<int>      elements;
  for (std::size_t k = 0; k < group.size(); ++k)
    {
      member[group[k]] = static_cast<int>(k);
      elements.insert(basis.elements_of(group[k]).begin(), basis.elements_of(group[k]).end());
    }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(group.size(), group.size());
  for (const int e : elements)
    {
      const auto rows      = extraction(basis, e);
      const auto functions = basis.functions_of(e);
      for (std::size_t k = 0; k < functions.size(); ++k)
        for (std::size_t l = 0; l < functions.size(); ++l)
          if (member.contains(functions[k]) && member.contains(functions[l]))
            gram(member[functions[k]], member[functions[l]]) +=
                std::inner_product(rows.row(k).begin(), rows.row(k).end(), rows.row(l).begin(), 0.);
    }
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * gram * scale.asDiagonal();
}

/// Indices that take part in a null vector of a positive semidefinite matrix with unit diagonal.
///
/// Gauss-Jordan elimination with the largest remaining diagonal entry as pivot, the squared distance of that function
/// from the span of those before. What remains when all distances vanish are combinations of the pivots.
std::vector<int> null_space_support(Eigen::MatrixXd matrix)
{
  // Distances of dependent functions vanish up to rounding, 1e-16 times the size of the group; those of independent
  // ones are bounded by the condition of the B-splines.
  constexpr double  pivot_tolerance = 1e-12, member_tolerance = 1e-6;
  const auto        n = matrix.rows();
  std::vector<char> is_pivot(n, 0);
  for (Eigen::Index step = 0; step < n; ++step)
    {
      Eigen::Index pivot = -1;
      for (Eigen::Index k = 0; k < n; ++k)
        if (!is_pivot[k] && (pivot < 0 || matrix(k, k) > matrix(pivot, pivot)))
          pivot = k;
      if (matrix(pivot, pivot) < pivot_tolerance)
        break;
      is_pivot[pivot] = 1;
      matrix.row(pivot) /= matrix(pivot, pivot);
      for (Eigen::Index k = 0; k < n; ++k)
        if (k != pivot && matrix(k, pivot) != 0.)
          matrix.row(k) -= matrix(k, pivot) * matrix.row(pivot);
    }
  std::vector<char> takes_part(n, 0);
  for (Eigen::Index j = 0; j < n; ++j)
    if (!is_pivot[j])
      {
        takes_part[j] = 1;
        for (Eigen::Index k = 0; k < n; ++k)
          if (is_pivot[k] && std::abs(matrix(k, j)) > member_tolerance)
            takes_part[k] = 1;
      }
  std::vector<int> result;
  for (Eigen::Index k = 0; k < n; ++k)
    if (takes_part[k])
      result.push_back(static_cast<int>(k));
  return result;
}

} // namespace

template <int degree>
Independence check_independence(const LRBasis<degree> &basis)
{
  Independence result;
  for (int e = 0; e < basis.n_elements(); ++e)
    if (is_overloaded(basis, e))
      result.overloaded_elements.push_back(e);
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      const auto elements = basis.elements_of(i);
      if (std::all_of(elements.begin(), elements.end(), [&](int e) { return is_overloaded(basis, e); }))
        result.overloaded_functions.push_back(i);
    }
  result.left_after_peeling = peel(basis, result.overloaded_functions);
  for (const auto &group : connected_groups(basis, result.left_after_peeling))
    for (const int k : null_space_support(gram_matrix(basis, group)))
      result.dependent.push_back(group[k]);
  std::sort(result.dependent.begin(), result.dependent.end());
  return result;
}

template Independence check_independence(const LRBasis<2> &);
template Independence check_independence(const LRBasis<3> &);
template Independence check_independence(const LRBasis<4> &);

} // namespace sherd
