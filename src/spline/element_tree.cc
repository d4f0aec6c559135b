#include <sherd/spline/element_tree.h>

#include <algorithm>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
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

/// A halving of a box that has the first @p n_lower of its elements below it and the others above.
struct Halving
{
  Direction   direction;
  double      value;
  std::size_t n_lower;
};

/// The halving nearest to the middle of the list; n_lower = 0 if there is none.
Halving find_halving(std::span<const Box> elements)
{
  const auto          n = elements.size();
  Halving             best{Direction::u, 0., 0};
  std::vector<double> lowest(n + 1, elements.back().max[0]);
  const auto          off_middle = [n](std::size_t k) { return k > n - k ? k - (n - k) : n - k - k; };
  for (const Direction direction : {Direction::u, Direction::v})
    {
      const int d = static_cast<int>(direction);
      lowest[n]   = elements.back().max[d];
      for (std::size_t k = n; k-- > 0;)
        lowest[k] = std::min(lowest[k + 1], elements[k].min[d]);
      double highest = elements[0].max[d];
      for (std::size_t k = 1; k < n; ++k)
        {
          if (highest == lowest[k] && (best.n_lower == 0 || off_middle(k) < off_middle(best.n_lower)))
            best = {direction, highest, k};
          highest = std::max(highest, elements[k].max[d]);
        }
    }
  return best;
}

std::string text(const Box &box)
{
  return "[" + print(box.min[0]) + ", " + print(box.max[0]) + "] x [" + print(box.min[1]) + ", " + print(box.max[1]) +
         "]";
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

ElementTree::ElementTree(std::span<const double> knots_u, std::span<const double> knots_v,
                         std::span<const Box> elements)
    : ElementTree(knots_u, knots_v)
{
  const auto cells = std::move(boxes_);
  boxes_.clear();
  node_of_element_.clear();
  for (std::size_t c = 0; c < cells.size(); ++c)
    {
      const auto last = std::find_if(elements.begin(), elements.end(),
                                     [&](const Box &element) { return !contains(cells[c], element); });
      const auto n    = static_cast<std::size_t>(last - elements.begin());
      rebuild_node(static_cast<int>(c), cells[c], elements.first(n));
      elements = elements.subspan(n);
    }
  if (!elements.empty())
    throw InvalidParameter("element tree: element " + std::to_string(boxes_.size()) + ", " + text(elements[0]) +
                           ", is out of order or outside the domain");
}

void ElementTree::rebuild_node(int node, const Box &box, std::span<const Box> elements)
{
  if (elements.size() == 1 && elements[0] == box)
    {
      nodes_[node].element = static_cast<int>(boxes_.size());
      node_of_element_.push_back(node);
      boxes_.push_back(box);
      return;
    }
  const auto halving = elements.empty() ? Halving{Direction::u, 0., 0} : find_halving(elements);
  if (halving.n_lower == 0)
    throw InvalidParameter("element tree: the " + std::to_string(elements.size()) + " elements from number " +
                           std::to_string(boxes_.size()) + " on do not fill " + text(box) +
                           " in an order that halvings give");
  const int child        = static_cast<int>(nodes_.size());
  nodes_[node].value     = halving.value;
  nodes_[node].direction = halving.direction;
  nodes_[node].child     = child;
  nodes_[node].element   = -1;
  nodes_.resize(nodes_.size() + 2);
  rebuild_node(child, lower_part(box, halving.direction, halving.value), elements.first(halving.n_lower));
  rebuild_node(child + 1, upper_part(box, halving.direction, halving.value), elements.subspan(halving.n_lower));
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

void ElementTree::append_inside(const Box &box, std::vector<int> &elements) const
{
  const auto first = [](const std::vector<double> &grid, double x) {
    return std::lower_bound(grid.begin(), grid.end(), x) - grid.begin();
  };
  const auto i_first = std::max<std::ptrdiff_t>(first(grid_[0], box.min[0]) - 1, 0);
  const auto j_first = std::max<std::ptrdiff_t>(first(grid_[1], box.min[1]) - 1, 0);
  const auto n_first = elements.size();
  for (auto j = j_first; j + 1 < std::ssize(grid_[1]) && grid_[1][j] < box.max[1]; ++j)
    for (auto i = i_first; i + 1 < std::ssize(grid_[0]) && grid_[0][i] < box.max[0]; ++i)
      append_inside(root(i, j), {{grid_[0][i], grid_[1][j]}, {grid_[0][i + 1], grid_[1][j + 1]}}, box, elements);
  std::sort(elements.begin() + n_first, elements.end());
}

void ElementTree::append_inside(int node, const Box &cell, const Box &box, std::vector<int> &elements) const
{
  for (int d = 0; d < 2; ++d)
    if (cell.max[d] <= box.min[d] || box.max[d] <= cell.min[d])
      return;
  const Node &n = nodes_[node];
  if (n.child >= 0)
    {
      append_inside(n.child, lower_part(cell, n.direction, n.value), box, elements);
      append_inside(n.child + 1, upper_part(cell, n.direction, n.value), box, elements);
    }
  else if (contains(box, cell))
    elements.push_back(n.element);
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
