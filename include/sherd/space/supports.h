#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sherd/space/shell_space.h>

namespace sherd
{

/// Component of the displacement.
enum class Component
{
  x = 0,
  y = 1,
  z = 2
};

/// Strong supports on named edges of a surface: a displacement component is prescribed as a function of time, the same
/// along the whole edge. Declared once; they follow refinement because they name edges, not unknowns.
class Supports
{
public:
  struct Support
  {
    std::string                   edge;
    Component                     component;
    std::function<double(double)> displacement; ///< of time, [length]
  };

  /// u_component = 0 on @p edge.
  void fix(const std::string &edge, Component component)
  {
    prescribe(edge, component, [](double) { return 0.; });
  }

  /// u_component = displacement(t) on @p edge.
  void prescribe(const std::string &edge, Component component, std::function<double(double)> displacement)
  {
    supports_.push_back({edge, component, std::move(displacement)});
  }

  const std::vector<Support> &list() const { return supports_; }

private:
  std::vector<Support> supports_;
};

/// One supported unknown of this rank.
struct Constraint
{
  int point;     ///< local control point, ghosts included
  int component; ///< of the displacement
  int support;   ///< index into Supports::list()
};

/// Supported unknowns among the local control points of @p space, each once; where edges meet, the support declared
/// last holds. @throws InvalidParameter   unknown edge; a component beyond the dimension of the space
template <int degree, int spacedim>
std::vector<Constraint> constraints(const Supports &supports, const ShellSpace<degree, spacedim> &space)
{
  const auto      &local = space.distribution().local;
  std::vector<int> chosen(space.surface().n_control_points() * spacedim, -1);
  for (std::size_t s = 0; s < supports.list().size(); ++s)
    {
      const auto &support   = supports.list()[s];
      const int   component = static_cast<int>(support.component);
      if (component >= spacedim)
        throw InvalidParameter("support of edge \"" + support.edge + "\": component " + std::to_string(component) +
                               " does not exist, the surface lies in " + std::to_string(spacedim) + " dimensions");
      for (const auto &edge : space.surface().edge(support.edge))
        for (const int point : points_along(space.surface(), edge))
          chosen[point * spacedim + component] = static_cast<int>(s);
    }
  std::vector<Constraint> result;
  for (int i = 0; i < static_cast<int>(chosen.size()); ++i)
    if (chosen[i] >= 0 && local[i / spacedim] >= 0)
      result.push_back({local[i / spacedim], i % spacedim, chosen[i]});
  return result;
}

} // namespace sherd
