#pragma once

#include <array>
#include <span>
#include <vector>

#include <sherd/spline/mesh_line.h>

namespace sherd
{

class LRMesh;

/// Elements of an LR mesh as a forest: one binary tree of halvings (not necessarily in the middle) for each cell of the
/// initial tensor mesh.
///
/// An element is split by every line that crosses it from edge to edge, and its parts again, until none does. A line
/// that ends inside an element does not split it. The result depends only on the lines, not on the order of the splits:
/// two lines that cross an element also cross the parts the other makes.  theory H.5
///
/// Numbering: parts of an element follow each other and take the place of their parent.
class ElementTree
{
public:
  /// Tensor mesh of the distinct values of two knot vectors; element j n_u + i is cell i along u, j along v.
  ElementTree(std::span<const double> knots_u, std::span<const double> knots_v);

  /// A tree with these @p elements, in the order of their numbers. The halvings that led to them may have been others;
  /// later splits and their numbering do not depend on that.
  /// @throws InvalidParameter   unless they are parts of the cells of the tensor mesh in an order that halvings give
  ElementTree(std::span<const double> knots_u, std::span<const double> knots_v, std::span<const Box> elements);

  /// Boxes of all elements.
  const std::vector<Box> &elements() const { return boxes_; }

  /// Element that holds (u, v): half-open [min, max), closed at the right end of the domain; -1 outside the domain.
  int element_at(double u, double v) const;

  /// Appends to @p elements those that the line touches along more than a point, be it along an edge.
  void append_touching(const MeshLine &line, std::vector<int> &elements) const;

  /// Appends to @p elements, ascending, those that lie in @p box.
  void append_inside(const Box &box, std::vector<int> &elements) const;

  /// Splits the @p candidates (ascending element numbers) by the lines of @p mesh and renumbers.
  /// @return parent[new element] = old element
  std::vector<int> split(std::span<const int> candidates, const LRMesh &mesh);

private:
  struct Node
  {
    double    value     = 0.;           ///< where it is split
    int       child     = -1;           ///< first of two children, the lower one; -1 for an element
    int       element   = -1;           ///< number of the element
    Direction direction = Direction::u; ///< direction of the line that splits it
  };

  int  root(std::size_t i, std::size_t j) const { return static_cast<int>(j * (grid_[0].size() - 1) + i); }
  void append_touching(int node, Box box, const MeshLine &line, std::vector<int> &elements) const;
  void append_inside(int node, const Box &cell, const Box &box, std::vector<int> &elements) const;
  void rebuild_node(int node, const Box &box, std::span<const Box> elements);
  void split_node(int node, const Box &box, const LRMesh &mesh);
  void number_elements(int node, const Box &box);

  std::array<std::vector<double>, 2> grid_;            ///< distinct initial knots
  std::vector<Node>                  nodes_;           ///< the first ones are the cells of the initial mesh
  std::vector<int>                   node_of_element_; ///< shape=(n_elements)
  std::vector<Box>                   boxes_;           ///< shape=(n_elements)
};

} // namespace sherd
