#include <sherd/spline/element_tree.h>

#include <algorithm>

#include <sherd/spline/lr_mesh.h>

namespace sherd
{

namespace
{

std::vector<double> distinct(std::span<const double> knots)
{
  std::vector<double> result(knots.begin(), knots.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Cell of an ascending grid that holds x: half-open, closed at the right end; -1 outside.
int cell_at(const std::vector<double> &grid, double x)
{
  if (!(grid.front() <= x && x <= grid.back()))
    return -1;
  const auto right = std::upper_bound(grid.begin(), grid.end() - 1, x);
  return static_cast<int>(right - grid.begin()) - 1;
}

/// Value of a line of the given direction that crosses the whole box, near the middle of all such; no value if none.
const LRMesh::Line *crossing(Direction direction, const Box &box, const LRMesh &mesh)
{
  const int                         d = static_cast<int>(direction), o = 1 - d;
  std::vector<const LRMesh::Line *> lines;
  for (const auto &line : mesh.between(direction, box.min[d], box.max[d]))
    if (line.multiplicity(box.min[o], box.max[o]) > 0)
      lines.push_back(&line);
  return lines.empty() ? nullptr : lines[lines.size() / 2];
}

Box lower_part(Box box, Direction direction, double value)
{
  box.max[static_cast<int>(direction)] = value;
  return box;
}

Box upper_part(Box box, Direction direction, double value)
{
  box.min[static_cast<int>(direction)] = value;
  return box;
}

} // namespace

ElementTree::ElementTree(std::span<const double> knots_u, std::span<const double> knots_v)
    : grid_{distinct(knots_u), distinct(knots_v)}
{
  for (std::size_t j = 0; j + 1 < grid_[1].size(); ++j)
    for (std::size_t i = 0; i + 1 < grid_[0].size(); ++i)
      {
        const int e = static_cast<int>(boxes_.size());
        nodes_.push_back({.element = e});
        node_of_element_.push_back(e);
        boxes_.push_back({{grid_[0][i], grid_[1][j]}, {grid_[0][i + 1], grid_[1][j + 1]}});
      }
}

int ElementTree::element_at(double u, double v) const
{
  const int i = cell_at(grid_[0], u), j = cell_at(grid_[1], v);
  if (i < 0 || j < 0)
    return -1;
  int node = root(i, j);
  while (nodes_[node].child >= 0)
    {
      const double x = nodes_[node].direction == Direction::u ? u : v;
      node           = nodes_[node].child + (x < nodes_[node].value ? 0 : 1);
    }
  return nodes_[node].element;
}

void ElementTree::append_touching(const MeshLine &line, std::vector<int> &elements) const
{
  const int   d    = static_cast<int>(line.direction);
  const auto &grid = grid_[d], &along = grid_[1 - d];
  const auto  cell = [](const std::vector<double> &g, std::vector<double>::const_iterator right) {
    return std::clamp<std::ptrdiff_t>(right - g.begin() - 1, 0, g.size() - 2);
  };
  const auto first_across = cell(grid, std::lower_bound(grid.begin(), grid.end(), line.value));
  const auto last_across  = cell(grid, std::upper_bound(grid.begin(), grid.end(), line.value));
  const auto first_along  = cell(along, std::upper_bound(along.begin(), along.end(), line.start));
  const auto last_along   = cell(along, std::lower_bound(along.begin(), along.end(), line.end));
  for (auto a = first_along; a <= last_along; ++a)
    for (auto c = first_across; c <= last_across; ++c)
      {
        const auto i = d == 0 ? c : a, j = d == 0 ? a : c;
        append_touching(root(i, j), {{grid_[0][i], grid_[1][j]}, {grid_[0][i + 1], grid_[1][j + 1]}}, line, elements);
      }
}

void ElementTree::append_touching(int node, Box box, const MeshLine &line, std::vector<int> &elements) const
{
  const int d = static_cast<int>(line.direction), o = 1 - d;
  if (line.value < box.min[d] || box.max[d] < line.value || line.end <= box.min[o] || box.max[o] <= line.start)
    return;
  const Node &n = nodes_[node];
  if (n.child < 0)
    elements.push_back(n.element);
  else
    {
      append_touching(n.child, lower_part(box, n.direction, n.value), line, elements);
      append_touching(n.child + 1, upper_part(box, n.direction, n.value), line, elements);
    }
}

std::vector<int> ElementTree::split(std::span<const int> candidates, const LRMesh &mesh)
{
  for (const int e : candidates)
    split_node(node_of_element_[e], boxes_[e], mesh);

  const auto       old_boxes = std::move(boxes_);
  const auto       old_nodes = std::move(node_of_element_);
  std::vector<int> parent;
  boxes_.clear();
  node_of_element_.clear();
  boxes_.reserve(old_boxes.size() + nodes_.size() / 2);
  for (std::size_t e = 0; e < old_boxes.size(); ++e)
    {
      number_elements(old_nodes[e], old_boxes[e]);
      parent.resize(boxes_.size(), static_cast<int>(e));
    }
  return parent;
}

void ElementTree::split_node(int node, const Box &box, const LRMesh &mesh)
{
  for (const Direction direction : {Direction::u, Direction::v})
    if (const auto *line = crossing(direction, box, mesh))
      {
        const int child        = static_cast<int>(nodes_.size());
        nodes_[node].value     = line->value;
        nodes_[node].direction = direction;
        nodes_[node].child     = child;
        nodes_[node].element   = -1;
        nodes_.resize(nodes_.size() + 2);
        split_node(child, lower_part(box, direction, line->value), mesh);
        split_node(child + 1, upper_part(box, direction, line->value), mesh);
        return;
      }
}

void ElementTree::number_elements(int node, const Box &box)
{
  const Node &n = nodes_[node];
  if (n.child >= 0)
    {
      number_elements(n.child, lower_part(box, n.direction, n.value));
      number_elements(n.child + 1, upper_part(box, n.direction, n.value));
      return;
    }
  nodes_[node].element = static_cast<int>(boxes_.size());
  node_of_element_.push_back(node);
  boxes_.push_back(box);
}

} // namespace sherd
