#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <sherd/space/region.h>
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

/// Rows of control points that a support on an edge holds.
enum class Rows
{
  first,       ///< position
  first_second ///< position and tangent plane (points_along and second_row_along)
};

/// Supports of a surface: displacement components that are zero or prescribed functions of time, the same on the whole
/// region, and conditions on the tangent plane and the phase field along edges. These have a strong form, exact, by the
/// control points next to the edge, and a weak one, by penalty, that asks nothing of the parameter lines there.
/// Declared once; they follow refinement because they name edges, not unknowns. Where regions meet, the displacement
/// declared last holds.
class Supports
{
public:
  struct Support
  {
    Region                        region;
    std::optional<Component>      component; ///< all of them if empty
    Rows                          rows;
    std::function<double(double)> displacement;    ///< of time, [length]
    bool                          at_rest = false; ///< whether it is zero at all times
  };

  /// An edge across which values are level.
  struct Symmetry
  {
    std::string              edge;
    std::optional<Component> normal; ///< of the plane of symmetry; empty: of the phase alone
  };

  /// A condition along an edge by penalty, forms/weak_edge.h.
  struct WeakEdge
  {
    /// The normal is the reference normal, turned about the edge by an angle of time.
    struct HeldNormal
    {
      std::function<double(double)> angle;
    };
    /// The normal keeps its component along an axis.
    struct SymmetricNormal
    {
      Component axis;
    };
    /// The derivative of the phase across the edge vanishes.
    struct LevelPhase
    {
    };

    std::string                                           edge;
    std::variant<HeldNormal, SymmetricNormal, LevelPhase> condition;
    double                                                factor; ///< beta of theory G.3; 0: the default
  };

  /// u_component = 0 on @p region.
  void fix(Region region, Component component);

  /// u = 0 on @p region.
  void fix(Region region);

  /// u_component = displacement(t) on @p region.
  void prescribe(Region region, Component component, std::function<double(double)> displacement);

  /// u = 0 on @p edge, and its tangent plane stays: the two outer rows of control points are fixed.  theory G.5
  void clamp(const std::string &edge);

  /// u_component = displacement(t) on @p edge without a part in any rotation: both outer rows move alike. With every
  /// component clamped or prescribed so, the edge translates and its tangent plane keeps its direction.
  void prescribe_clamped(const std::string &edge, Component component, std::function<double(double)> displacement);

  /// @p edge lies in a plane of symmetry with the axis @p normal as its normal: u_normal = 0 on it, and the derivatives
  /// of the other components and of the phase across it vanish (ties, for the fourth-order phase field as well).
  /// The surface has to meet the plane at right angles, and so have the parameter lines.  theory G.5
  void symmetry(const std::string &edge, Component normal);

  /// The derivative of the phase across @p edge vanishes; displacements are not touched.
  void phase_symmetry(const std::string &edge);

  /// clamp() in weak form: u = 0 on @p edge, and its normal is held by penalty, also where parameter lines cross the
  /// edge at any angle and where it is rational.
  /// @param factors   of the penalties, by default those that continuity across interfaces has (theory G.3)
  void clamp_weakly(const std::string &edge, const continuity::Penalty &factors = {});

  /// Turns the normal along @p edge by angle(t) about the edge, by penalty: a positive angle takes it towards the
  /// outward conormal of the reference surface, as a positive edge moment does. Displacements are not touched.
  void rotate(const std::string &edge, std::function<double(double)> angle, const continuity::Penalty &factors = {});

  /// symmetry() in weak form: u_normal = 0 on @p edge, the normal of the surface stays in the plane of symmetry and the
  /// phase level across the edge, both by penalty. The surface has to meet the plane at right angles, parameter lines
  /// need not.
  void symmetry_weakly(const std::string &edge, Component normal, const continuity::Penalty &factors = {});

  /// phase_symmetry() in weak form.
  void phase_symmetry_weakly(const std::string &edge, const continuity::Penalty &factors = {});

  const std::vector<Support>  &list() const { return supports_; }
  const std::vector<Symmetry> &symmetries() const { return symmetries_; }
  const std::vector<WeakEdge> &weak_edges() const { return weak_edges_; }

private:
  std::vector<Support>  supports_;
  std::vector<Symmetry> symmetries_;
  std::vector<WeakEdge> weak_edges_;
};

/// The number of @p component. @p where names the support in the message.
/// @throws InvalidParameter   a component beyond @p spacedim, with those there are
int component_index(Component component, int spacedim, const std::string &where);

/// Which support holds each displacement component, -1: none; entry point * spacedim + component, surface numbering.
/// @throws InvalidParameter   from points_of; a component beyond the dimension of the space
template <int degree, int spacedim>
std::vector<int> holders(const Supports &supports, const Surface<degree, spacedim> &surface)
{
  std::vector<int> chosen(surface.n_control_points() * spacedim, -1);
  for (std::size_t s = 0; s < supports.list().size(); ++s)
    {
      const auto &support = supports.list()[s];
      int         first = 0, last = spacedim;
      if (support.component)
        {
          first = component_index(*support.component, spacedim, describe(support.region));
          last  = first + 1;
        }
      auto points = points_of(support.region, surface);
      if (support.rows == Rows::first_second)
        for (const auto &edge : surface.edge(std::get<std::string>(support.region.part)))
          for (const int point : second_row_along(surface, edge))
            points.push_back(point);
      for (const int point : points)
        for (int component = first; component < last; ++component)
          chosen[point * spacedim + component] = static_cast<int>(s);
    }
  return chosen;
}

/// One supported unknown of this rank.
struct Constraint
{
  int point;     ///< local control point, ghosts included
  int component; ///< of the displacement
  int support;   ///< index into Supports::list()
};

/// Supported unknowns among the local control points of @p space, each once; where regions meet, the support declared
/// last holds. @throws InvalidParameter   as holders
template <int degree, int spacedim>
std::vector<Constraint> constraints(const Supports &supports, const ShellSpace<degree, spacedim> &space)
{
  const auto             &local  = space.distribution().local;
  const auto              chosen = holders(supports, space.surface());
  std::vector<Constraint> result;
  for (int i = 0; i < static_cast<int>(chosen.size()); ++i)
    if (chosen[i] >= 0 && local[i / spacedim] >= 0)
      result.push_back({local[i / spacedim], i % spacedim, chosen[i]});
  return result;
}

} // namespace sherd
