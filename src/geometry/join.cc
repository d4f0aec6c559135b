#include <sherd/geometry/join.h>

#include <algorithm>

namespace sherd
{
namespace
{

bool same(const Edge &a, const Edge &b)
{
  return a.patch == b.patch && a.side == b.side;
}

bool has_side(const std::vector<Interface> &interfaces, const Edge &edge)
{
  return std::any_of(interfaces.begin(), interfaces.end(),
                     [&](const Interface &joined) { return same(joined.first, edge) || same(joined.second, edge); });
}

/// Whether the parameter along a side runs round its patch from u towards v.
bool runs_round(Side side)
{
  return side == Side::v_min || side == Side::u_max;
}

} // namespace

template <int degree, int spacedim>
Surface<degree, spacedim> join(const std::vector<Surface<degree, spacedim>> &parts)
{
  if (parts.empty())
    throw InvalidParameter("join: no surface, expected at least one");
  std::vector<Patch<degree, spacedim>>     patches;
  std::map<std::string, std::vector<Edge>> edges;
  std::vector<Interface>                   before;
  for (const auto &part : parts)
    {
      const int  offset = static_cast<int>(patches.size());
      const auto moved  = [&](Edge edge) {
        edge.patch += offset;
        return edge;
      };
      for (const auto &[name, sides] : part.edges())
        for (const auto &side : sides)
          edges[name].push_back(moved(side));
      for (const auto &joined : part.interfaces())
        before.push_back({moved(joined.first), moved(joined.second), joined.reversed});
      for (int p = 0; p < part.n_patches(); ++p)
        patches.push_back(part.patch(p));
    }
  auto interfaces = find_interfaces(patches);
  for (auto edge = edges.begin(); edge != edges.end();)
    {
      std::erase_if(edge->second,
                    [&](const Edge &side) { return has_side(interfaces, side) && !has_side(before, side); });
      edge = edge->second.empty() ? edges.erase(edge) : std::next(edge);
    }
  return {std::move(patches), std::move(edges), std::move(interfaces)};
}

bool normals_agree(const Interface &joined)
{
  return (runs_round(joined.first.side) == runs_round(joined.second.side)) == joined.reversed;
}

template Surface<2, 2> join(const std::vector<Surface<2, 2>> &);
template Surface<3, 2> join(const std::vector<Surface<3, 2>> &);
template Surface<4, 2> join(const std::vector<Surface<4, 2>> &);
template Surface<2, 3> join(const std::vector<Surface<2, 3>> &);
template Surface<3, 3> join(const std::vector<Surface<3, 3>> &);
template Surface<4, 3> join(const std::vector<Surface<4, 3>> &);

} // namespace sherd
