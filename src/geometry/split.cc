#include <sherd/geometry/split.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include <sherd/base/instantiate.h>
#include <sherd/base/print.h>
#include <sherd/geometry/tensor_product.h>

namespace sherd
{
namespace
{

/// Parameters closer than this part of the domain are one.
constexpr double same = 1e-12;

template <int degree, int spacedim>
Patch<degree, spacedim> unrefined(const Patch<degree, spacedim> &patch, const std::string &which)
{
  auto result = tensor_product(patch);
  if (!result)
    throw InvalidParameter("split: " + which + " was refined locally, expected a tensor product of two knot vectors; " +
                           "cut the surface before it is refined");
  return std::move(*result);
}

/// @p parameter, or the knot that is the same but for rounding.
double snapped(const std::vector<double> &knots, double parameter)
{
  const double slack = same * (knots.back() - knots.front());
  const auto   next  = std::lower_bound(knots.begin(), knots.end(), parameter - slack);
  return next != knots.end() && *next <= parameter + slack ? *next : parameter;
}

/// Cuts of one direction of one patch, ascending.
struct Cuts
{
  std::vector<double> knots;
  std::vector<double> parameters = {};

  /// Whether there is something new to cut: not the boundary, not an earlier cut.
  bool insert(double parameter)
  {
    parameter          = snapped(knots, parameter);
    const double slack = same * (knots.back() - knots.front());
    if (parameter - knots.front() <= slack || knots.back() - parameter <= slack)
      return false;
    const auto next = std::lower_bound(parameters.begin(), parameters.end(), parameter - slack);
    if (next != parameters.end() && *next <= parameter + slack)
      return false;
    parameters.insert(next, parameter);
    return true;
  }

  int n_parts() const { return static_cast<int>(parameters.size()) + 1; }
};

/// The parameter of a point of an interface on its other side, which has knots @p to along it.
double across_interface(const std::vector<double> &from, const std::vector<double> &to, bool reversed, double parameter)
{
  if (from.size() == to.size())
    if (const auto knot = std::find(from.begin(), from.end(), parameter); knot != from.end())
      return reversed ? to[to.size() - 1 - (knot - from.begin())] : to[knot - from.begin()];
  const double share = (parameter - from.front()) / (from.back() - from.front()), length = to.back() - to.front();
  return reversed ? to.back() - share * length : to.front() + share * length;
}

Direction along(Side side)
{
  return side == Side::u_min || side == Side::u_max ? Direction::v : Direction::u;
}

/// All cuts of a surface, and the new numbers of its parts.
template <int degree, int spacedim>
class Scissors
{
public:
  explicit Scissors(const Surface<degree, spacedim> &surface) : surface_(surface)
  {
    for (int p = 0; p < surface.n_patches(); ++p)
      {
        patches_.push_back(unrefined(surface.patch(p), "patch " + std::to_string(p)));
        const auto &knots = patches_.back().basis.initial_knots();
        cuts_.push_back({Cuts{knots[0]}, Cuts{knots[1]}});
      }
  }

  const std::vector<double> &knots(int p, Direction direction) const
  {
    return patches_[p].basis.initial_knots()[static_cast<int>(direction)];
  }

  /// Cuts patch @p p, and all that the cut runs into.
  void cut(int p, Direction direction, double parameter)
  {
    if (!cuts_[p][static_cast<int>(direction)].insert(parameter))
      return;
    struct Cut
    {
      int       patch;
      Direction direction;
      double    parameter;
    };
    std::deque<Cut> waiting{{p, direction, snapped(knots(p, direction), parameter)}};
    while (!waiting.empty())
      {
        const Cut now = waiting.front();
        waiting.pop_front();
        const auto continue_at = [&](const Edge &here, const Edge &there, bool reversed) {
          if (here.patch != now.patch || along(here.side) != now.direction)
            return;
          const auto   next = along(there.side);
          const double t =
              across_interface(knots(here.patch, now.direction), knots(there.patch, next), reversed, now.parameter);
          if (cuts_[there.patch][static_cast<int>(next)].insert(t))
            waiting.push_back({there.patch, next, snapped(knots(there.patch, next), t)});
        };
        for (const auto &joined : surface_.interfaces())
          {
            continue_at(joined.first, joined.second, joined.reversed);
            continue_at(joined.second, joined.first, joined.reversed);
          }
      }
  }

  Surface<degree, spacedim> parts() const
  {
    std::vector<Patch<degree, spacedim>> parts;
    std::vector<int>                     first;
    std::vector<Interface>               interfaces;
    for (int p = 0; p < surface_.n_patches(); ++p)
      {
        first.push_back(static_cast<int>(parts.size()));
        auto of_patch = split_patches(patches_[p], cuts_[p][0].parameters, cuts_[p][1].parameters);
        std::move(of_patch.begin(), of_patch.end(), std::back_inserter(parts));
        const int n_u = cuts_[p][0].n_parts(), n_v = cuts_[p][1].n_parts();
        for (int j = 0; j < n_v; ++j)
          for (int i = 0; i < n_u; ++i)
            {
              const int here = first[p] + j * n_u + i;
              if (i + 1 < n_u)
                interfaces.push_back({{here, Side::u_max}, {here + 1, Side::u_min}, false});
              if (j + 1 < n_v)
                interfaces.push_back({{here, Side::v_max}, {here + n_u, Side::v_min}, false});
            }
      }
    // Parts of a side, in the order of the parameter along it.
    const auto sides = [&](const Edge &edge) {
      const int         n_u = cuts_[edge.patch][0].n_parts(), n_v = cuts_[edge.patch][1].n_parts();
      std::vector<Edge> result;
      const int         n = along(edge.side) == Direction::u ? n_u : n_v;
      for (int k = 0; k < n; ++k)
        {
          const int i = edge.side == Side::u_min ? 0 : edge.side == Side::u_max ? n_u - 1 : k;
          const int j = edge.side == Side::v_min ? 0 : edge.side == Side::v_max ? n_v - 1 : k;
          result.push_back({first[edge.patch] + j * n_u + i, edge.side});
        }
      return result;
    };
    for (const auto &joined : surface_.interfaces())
      {
        const auto a = sides(joined.first);
        auto       b = sides(joined.second);
        if (joined.reversed)
          std::reverse(b.begin(), b.end());
        for (std::size_t k = 0; k < a.size(); ++k)
          interfaces.push_back({a[k], b[k], joined.reversed});
      }
    std::map<std::string, std::vector<Edge>> edges;
    for (const auto &[name, old] : surface_.edges())
      for (const auto &edge : old)
        for (const auto &side : sides(edge))
          edges[name].push_back(side);
    return {std::move(parts), std::move(edges), std::move(interfaces)};
  }

private:
  const Surface<degree, spacedim>     &surface_;
  std::vector<Patch<degree, spacedim>> patches_;
  std::vector<std::array<Cuts, 2>>     cuts_;
};

/// Parameters inside the domain, ascending; the knots instead of them where they are the same but for rounding.
std::vector<double> checked(const std::vector<double> &knots, std::vector<double> parameters, const char *name)
{
  for (double &t : parameters)
    {
      t = snapped(knots, t);
      if (!(knots.front() < t && t < knots.back()))
        throw InvalidParameter("split: cut at " + std::string(name) + " = " + print(t) + ", expected a value between " +
                               print(knots.front()) + " and " + print(knots.back()) + " (exclusive)");
    }
  if (std::adjacent_find(parameters.begin(), parameters.end(), std::greater_equal<>()) != parameters.end())
    throw InvalidParameter("split: the cuts " + std::string(name) + " = ... are not ascending");
  return parameters;
}

/// Where the part from @p begin to @p end of a direction lies: its open knots, and its functions first .. last.
struct Part
{
  std::vector<double> knots;
  int                 first, last;
};

template <int degree>
std::vector<Part> parts_of(const std::vector<double> &knots, std::vector<double> cuts)
{
  cuts.insert(cuts.begin(), knots.front());
  cuts.push_back(knots.back());
  // The function that is 1 at a knot of multiplicity degree.
  const auto at = [&](double t) {
    return std::max(0, static_cast<int>(std::lower_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1);
  };
  std::vector<Part> parts;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      Part part{std::vector<double>(degree + 1, cuts[k]), at(cuts[k]), at(cuts[k + 1])};
      part.knots.insert(part.knots.end(), std::upper_bound(knots.begin(), knots.end(), cuts[k]),
                        std::lower_bound(knots.begin(), knots.end(), cuts[k + 1]));
      part.knots.insert(part.knots.end(), degree + 1, cuts[k + 1]);
      parts.push_back(std::move(part));
    }
  return parts;
}

} // namespace

template <int degree, int spacedim>
std::vector<Patch<degree, spacedim>> split_patches(const Patch<degree, spacedim> &patch,
                                                   const std::vector<double> &at_u, const std::vector<double> &at_v)
{
  auto       whole  = unrefined(patch, "the patch");
  const auto cuts_u = checked(whole.basis.initial_knots()[0], at_u, "u");
  const auto cuts_v = checked(whole.basis.initial_knots()[1], at_v, "v");
  if (cuts_u.empty() && cuts_v.empty())
    return {std::move(whole)};

  const auto           &domain = whole.basis.domain();
  std::vector<MeshLine> lines;
  for (const double u : cuts_u)
    lines.push_back({Direction::u, u, domain.min[1], domain.max[1], degree});
  for (const double v : cuts_v)
    lines.push_back({Direction::v, v, domain.min[0], domain.max[0], degree});
  const auto transfer  = rational_transfer(whole.basis.insert(lines).transfer, whole.weights);
  whole.control_points = transfer.apply(whole.control_points);
  whole                = unrefined(whole, "the patch");

  const auto &knots   = whole.basis.initial_knots();
  const auto  parts_u = parts_of<degree>(knots[0], cuts_u), parts_v = parts_of<degree>(knots[1], cuts_v);
  const int   n_u = static_cast<int>(knots[0].size()) - degree - 1;
  std::vector<Patch<degree, spacedim>> parts;
  for (const auto &v : parts_v)
    for (const auto &u : parts_u)
      {
        const int               m_u = u.last - u.first + 1, m_v = v.last - v.first + 1;
        Patch<degree, spacedim> part{LRBasis<degree>(u.knots, v.knots), ControlValues<spacedim>(m_u * m_v, spacedim),
                                     Eigen::VectorXd(m_u * m_v)};
        for (int j = 0; j < m_v; ++j)
          {
            const int from                               = (v.first + j) * n_u + u.first;
            part.control_points.middleRows(j * m_u, m_u) = whole.control_points.middleRows(from, m_u);
            part.weights.segment(j * m_u, m_u)           = whole.weights.segment(from, m_u);
          }
        parts.push_back(std::move(part));
      }
  return parts;
}

template <int degree, int spacedim>
Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &surface, int patch, Direction direction,
                                        double parameter)
{
  if (patch < 0 || patch >= surface.n_patches())
    throw InvalidParameter("split: patch " + std::to_string(patch) + ", expected 0 to " +
                           std::to_string(surface.n_patches() - 1));
  Scissors<degree, spacedim> scissors(surface);
  checked(scissors.knots(patch, direction), {parameter}, direction == Direction::u ? "u" : "v");
  scissors.cut(patch, direction, parameter);
  return scissors.parts();
}

template <int degree, int spacedim>
Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &surface, const std::array<int, 2> &pieces)
{
  for (int d = 0; d < 2; ++d)
    if (pieces[d] < 1)
      throw InvalidParameter("split: pieces[" + std::to_string(d) + "] = " + std::to_string(pieces[d]) +
                             ", expected at least 1");
  Scissors<degree, spacedim> scissors(surface);
  for (int p = 0; p < surface.n_patches(); ++p)
    for (const auto direction : {Direction::u, Direction::v})
      {
        const auto  &knots = scissors.knots(p, direction);
        const int    n     = pieces[static_cast<int>(direction)];
        const double begin = knots.front(), length = knots.back() - begin;
        for (int k = 1; k < n; ++k)
          scissors.cut(p, direction, begin + k * length / n);
      }
  return scissors.parts();
}

template <int degree, int spacedim>
Surface<degree, spacedim> split_at_c0_lines(const Surface<degree, spacedim> &surface)
{
  Scissors<degree, spacedim> scissors(surface);
  for (int p = 0; p < surface.n_patches(); ++p)
    for (const auto direction : {Direction::u, Direction::v})
      {
        const auto knots = scissors.knots(p, direction);
        for (std::size_t k = degree + 1; k + 2 * degree < knots.size(); ++k)
          if (knots[k] == knots[k + degree - 1])
            scissors.cut(p, direction, knots[k]);
      }
  return scissors.parts();
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template std::vector<Patch<degree, spacedim>> split_patches(                                                         \
      const Patch<degree, spacedim> &, const std::vector<double> &, const std::vector<double> &);                      \
  template Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &, int, Direction, double);         \
  template Surface<degree, spacedim> split_patches(const Surface<degree, spacedim> &, const std::array<int, 2> &);     \
  template Surface<degree, spacedim> split_at_c0_lines(const Surface<degree, spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
