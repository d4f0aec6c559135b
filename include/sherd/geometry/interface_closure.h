#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <sherd/base/exceptions.h>
#include <sherd/geometry/interface.h>

namespace sherd::internal
{

inline std::string describe(const Interface &interface)
{
  return sherd::describe(interface.first) + " and " + sherd::describe(interface.second);
}

/// Functions along both sides of an interface, with marks that count along the first.
template <int degree>
struct InterfaceFunctions
{
  std::array<std::vector<SideFunction<degree>>, 2> sides;

  template <int spacedim>
  InterfaceFunctions(const std::vector<Patch<degree, spacedim>> &patches, const Interface &interface)
      : sides{side_functions(patches[interface.first.patch].basis, interface.first.side, false),
              side_functions(patches[interface.second.patch].basis, interface.second.side, interface.reversed)}
  {
  }

  bool agree() const
  {
    return std::equal(sides[0].begin(), sides[0].end(), sides[1].begin(), sides[1].end(),
                      [](const auto &a, const auto &b) { return a.marks == b.marks; });
  }
};

template <int degree, int spacedim>
SideRuler side_ruler(const Patch<degree, spacedim> &patch, Side side, bool reversed)
{
  return SideRuler(patch.basis.initial_knots()[1 - normal_direction(side)], reversed);
}

/// Refines the marked functions of each patch down to its target, by the structured mesh strategy, then sides of
/// interfaces until both carry the same functions (theory H.6). Bases alone: control points are left to the caller.
/// @param marked    functions of each patch
/// @return          what was done to each patch
/// @throws Error    if the sides of an interface do not come to agree
template <int degree, int spacedim>
std::vector<Refinement>
refine_joined(std::vector<Patch<degree, spacedim>> &patches, const std::vector<Interface> &interfaces,
              const std::vector<std::vector<int>> &marked, const std::vector<SpanTarget> &targets)
{
  std::vector<std::vector<MeshLine>> lines;
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    lines.push_back(structured_mesh_lines(patches[p].basis, marked[p], targets[p]));
  std::vector<std::optional<Refinement>> refined(patches.size());

  // Every round but the last inserts a knot that the other side has and this one has not, or halves spans above the
  // target; knots only travel, so that their number is limited. The limit is for surfaces whose interfaces lead a knot
  // back to another place.
  constexpr int largest_number_of_rounds = 1000;
  for (int round = 0; round < largest_number_of_rounds; ++round)
    {
      for (int p = 0; p < static_cast<int>(patches.size()); ++p)
        if (!lines[p].empty() || !refined[p])
          {
            auto inserted = patches[p].basis.insert(lines[p]);
            refined[p]    = refined[p] ? compose(inserted, *refined[p]) : std::move(inserted);
            lines[p].clear();
          }
      bool agree = true;
      for (const auto &interface : interfaces)
        {
          const InterfaceFunctions<degree> functions(patches, interface);
          if (functions.agree())
            continue;
          agree      = false;
          bool empty = true;
          for (int s = 0; s < 2; ++s)
            {
              const Edge &edge  = s == 0 ? interface.first : interface.second;
              const auto &patch = patches[edge.patch];
              const auto  ruler = side_ruler(patch, edge.side, s == 1 && interface.reversed);
              for (const auto &line : closing_lines(patch.basis, edge, ruler, functions.sides[s],
                                                    functions.sides[1 - s], targets[edge.patch]))
                {
                  lines[edge.patch].push_back(line);
                  empty = false;
                }
            }
          if (empty)
            throw Error("surface: refinement left different functions on " + describe(interface) +
                        "; refine a wider neighbourhood (theory H.6)");
        }
      if (agree)
        {
          std::vector<Refinement> result;
          for (auto &refinement : refined)
            result.push_back(std::move(*refinement));
          return result;
        }
    }
  throw Error("surface: refinement across interfaces did not end after " + std::to_string(largest_number_of_rounds) +
              " rounds; check whether a chain of interfaces leads a side "
              "back to itself at another scale");
}

} // namespace sherd::internal
