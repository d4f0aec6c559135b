#pragma once

#include <array>
#include <span>
#include <vector>

#include <sherd/spline/adjacency.h>
#include <sherd/spline/element_tree.h>
#include <sherd/spline/local_knots.h>
#include <sherd/spline/lr_mesh.h>
#include <sherd/spline/mesh_line.h>
#include <sherd/spline/refinement.h>

namespace sherd
{

/// LR B-spline B = N_u(u) N_v(v) with its own knots and its weight in the partition of unity.  theory H.1
template <int degree>
struct LRFunction
{
  std::array<LocalKnots<degree>, 2> knots; ///< (u, v), ascending
  double                            gamma; ///< in (0, 1]; sum_i gamma_i B_i = 1

  Box support() const { return {{knots[0].front(), knots[1].front()}, {knots[0].back(), knots[1].back()}}; }
};

/// What a basis consists of, for files.
template <int degree>
struct LRBasisParts
{
  std::array<std::vector<double>, 2> initial_knots; ///< (u, v)
  std::vector<MeshLine>              lines;         ///< LRBasis::mesh_lines
  std::vector<LRFunction<degree>>    functions;     ///< in the order of their numbers
  std::vector<Box>                   elements;      ///< in the order of their numbers
};

/// Locally refinable bivariate splines of one degree in both directions: mesh lines, functions and elements.
///
/// A field with control data c is sum_i c_i gamma_i B_i, and sum_i gamma_i B_i = 1. All functions have minimal support:
/// no line of the mesh crosses the whole support of a function with a multiplicity above that of its value in the local
/// knots. The functions depend only on the mesh, not on the order in which lines came.  theory H.1-H.5
///
/// Numbering is compact and changes with refinement: functions that stay keep their order and come first, new ones
/// follow; parts of an element take the place of their parent. Knots are compared exactly.
/// Not distributed: every rank holds the same basis and must refine it alike.
template <int degree>
class LRBasis
{
  static_assert(2 <= degree && degree <= 4, "degrees 2, 3 and 4 are built");

public:
  /// Tensor-product basis of two open knot vectors; function j n_u + i has index i along u, element likewise.
  /// @param knots_u, knots_v  ascending; first and last value degree + 1 times, others at most degree times
  /// @throws InvalidParameter  otherwise
  LRBasis(std::vector<double> knots_u, std::vector<double> knots_v);

  /// The basis that had these parts(), with the same numbers; later refinements give the same functions, bit by bit.
  /// @throws InvalidParameter   unless lines, elements and functions belong together: elements fill the domain, bounded
  ///                            and not crossed by lines; functions are minimal, cover each element at least
  ///                            (degree+1)^2 times, and sum_i gamma_i B_i = 1 at its centre
  explicit LRBasis(LRBasisParts<degree> parts);

  LRBasisParts<degree> parts() const { return {initial_knots_, mesh_lines_, functions_, tree_.elements()}; }

  int n_functions() const { return static_cast<int>(functions_.size()); }
  int n_elements() const { return static_cast<int>(tree_.elements().size()); }

  const LRFunction<degree> &function(int i) const { return functions_[i]; }

  /// Rectangle of element @p e; it lies inside one polynomial piece of every function.
  const Box &element(int e) const { return tree_.elements()[e]; }

  /// Functions whose support contains element @p e, ascending; at least (degree+1)^2.
  std::span<const int> functions_of(int e) const { return functions_of_element_[e]; }

  /// Elements in the support of function @p i, ascending.
  std::span<const int> elements_of(int i) const { return elements_of_function_[i]; }

  /// Element that holds (u, v): half-open, closed at the right end of the domain.
  /// @throws InvalidParameter  outside the domain
  int element_at(double u, double v) const;

  /// The parameter domain.
  const Box &domain() const { return domain_; }

  /// The initial knot vectors, (u, v).
  const std::array<std::vector<double>, 2> &initial_knots() const { return initial_knots_; }

  /// All lines, collinear ones merged (LRMesh::lines).
  const std::vector<MeshLine> &mesh_lines() const { return mesh_lines_; }

  /// Inserts @p lines, all at once, and splits functions and elements until all are minimal again.  theory H.3
  ///
  /// Overlapping and touching collinear lines merge; multiplicity means that of the line afterwards, and the larger of
  /// old and new counts. A line that crosses no support from side to side changes no function, one that ends inside an
  /// element does not split it, but both stay in the mesh and count once others extend them.
  /// The cost is proportional to the functions and elements near the lines, plus one copy of the tables.
  /// @throws InvalidParameter  value outside the open domain, start >= end, an end outside the domain, multiplicity
  ///                           outside 1..degree; nothing has changed then
  Refinement insert(std::span<const MeshLine> lines);

  /// Structured mesh refinement: inserts structured_mesh_lines(*this, functions, target).  theory H.4
  Refinement refine(std::span<const int> functions, const SpanTarget &target);

private:
  void check(const MeshLine &line) const;
  void check_elements() const;
  void check_functions() const;
  void check_partition_of_unity() const;
  void rebuild_adjacency(const std::vector<int> &parent, std::span<const int> origin, int n_old_elements);

  std::array<std::vector<double>, 2> initial_knots_;
  Box                                domain_;
  LRMesh                             mesh_;
  ElementTree                        tree_;
  std::vector<MeshLine>              mesh_lines_;
  std::vector<LRFunction<degree>>    functions_;
  Adjacency                          elements_of_function_, functions_of_element_;
};

/// Lines of the structured mesh strategy: for each of @p functions the midline of each knot span longer than the target
/// of its direction, across the whole support of the function; merged.  theory H.4
/// @throws InvalidParameter  a target that is not positive, a function number out of range
template <int degree>
std::vector<MeshLine> structured_mesh_lines(const LRBasis<degree> &basis, std::span<const int> functions,
                                            const SpanTarget &target);

extern template class LRBasis<2>;
extern template class LRBasis<3>;
extern template class LRBasis<4>;

} // namespace sherd
