#include <sherd/driver/boundary_parameters.h>

#include "given.h"

namespace sherd
{
namespace
{

std::vector<Region> regions(const SupportParameters &support, const std::string &where)
{
  std::vector<Region> regions;
  for (const auto &edge : support.edges)
    regions.emplace_back(edge);
  if (!support.corner.empty())
    {
      if (support.corner.size() != 2)
        throw InvalidParameter(where + ": corner names " + std::to_string(support.corner.size()) +
                               " edges, expected the two that meet in it");
      regions.emplace_back(Corner{support.corner[0], support.corner[1]});
    }
  if (support.patch)
    regions.emplace_back(PatchRegion{*support.patch});
  if (support.everywhere)
    regions.emplace_back(WholeSurface{});
  if (regions.empty())
    throw InvalidParameter(where + " holds nothing; give edges, corner, patch or everywhere: true");
  return regions;
}

std::optional<Component> component_of(const std::string &name)
{
  if (name == "all")
    return std::nullopt;
  return static_cast<Component>(name[0] - 'x');
}

} // namespace

void SupportParameters::declare(ParameterSection &section)
{
  section.choice("kind", kind,
                 {"fix", "prescribe", "clamp", "prescribe_clamped", "symmetry", "phase_symmetry", "clamp_weakly",
                  "symmetry_weakly", "phase_symmetry_weakly", "rotate"},
                 "fix: component zero; prescribe: component = displacement(t); clamp: position and tangent plane stay; "
                 "prescribe_clamped: moves without turning; symmetry: lies in a plane of symmetry whose normal is the "
                 "component; phase_symmetry: the phase is level across the edge; these weakly: by penalty, for any "
                 "parameter lines; rotate: turns by angle(t), by penalty");
  section.value("edges", edges, "names of edges that it holds");
  section.value("corner", corner, "names of two edges: it holds the point where they meet");
  section.value("patch", patch, range::at_least(0), "number of a patch that it holds");
  section.value("everywhere", everywhere, "whether it holds the whole surface");
  section.choice("component", component, {"all", "x", "y", "z"}, "component of the displacement");
  section.value("displacement", displacement, "length", "what is prescribed, a formula of time");
  section.value("angle", angle, "rad", "of rotate, a formula of time; positive towards the outward conormal");
}

void SupportParameters::add_to(Supports &supports, int dimension, const std::string &place) const
{
  const std::string where      = place + ": kind = " + kind;
  const bool        prescribes = kind == "prescribe" || kind == "prescribe_clamped";
  const bool        on_edges   = kind != "fix" && kind != "prescribe";
  const bool        moves      = displacement.expression() != "0";
  if (moves && !prescribes)
    throw InvalidParameter(where + " has no displacement, which is given; use prescribe or prescribe_clamped");
  if ((angle.expression() != "0") != (kind == "rotate"))
    throw InvalidParameter(where +
                           (kind == "rotate" ? " needs an angle" : " has no angle, which is given; leave it out"));
  if (dimension == 2 && (kind == "rotate" || kind == "clamp_weakly" || kind == "symmetry_weakly"))
    throw InvalidParameter(where + " is for shells, but surface.dimension = 2");
  if (on_edges && (edges.empty() || !corner.empty() || patch || everywhere))
    throw InvalidParameter(where + " is for edges; give them by name, and no corner, patch or everywhere");
  const auto chosen = component_of(component);
  if (dimension == 2 && component == "z")
    throw InvalidParameter(where + ": component = z in the plane, expected all, x or y");
  const bool is_symmetry = kind == "symmetry" || kind == "symmetry_weakly";
  if (!chosen && (prescribes || is_symmetry))
    throw InvalidParameter(where + " needs a component: x, y or z");
  if (chosen && on_edges && !prescribes && !is_symmetry)
    throw InvalidParameter(where + " has no component, but " + component + " is given; leave it out");

  const auto function = [formula = displacement](double t) { return formula(t); };
  if (!on_edges)
    for (auto &region : regions(*this, where))
      {
        if (kind == "prescribe")
          supports.prescribe(region, *chosen, function);
        else if (chosen)
          supports.fix(region, *chosen);
        else
          supports.fix(region);
      }
  else
    for (const auto &edge : edges)
      {
        if (kind == "clamp")
          supports.clamp(edge);
        else if (kind == "prescribe_clamped")
          supports.prescribe_clamped(edge, *chosen, function);
        else if (kind == "symmetry")
          supports.symmetry(edge, *chosen);
        else if (kind == "phase_symmetry")
          supports.phase_symmetry(edge);
        else if (kind == "clamp_weakly")
          supports.clamp_weakly(edge);
        else if (kind == "symmetry_weakly")
          supports.symmetry_weakly(edge, *chosen);
        else if (kind == "phase_symmetry_weakly")
          supports.phase_symmetry_weakly(edge);
        else
          supports.rotate(edge, [formula = angle](double t) { return formula(t); });
      }
}

void LoadParameters::declare(ParameterSection &section)
{
  section.choice("kind", kind, {"traction", "surface_load", "gravity", "point_load", "pressure", "edge_moment"},
                 "traction: vector by length of edges; surface_load: vector by area; gravity: vector of acceleration; "
                 "point_load: vector at a point; pressure: value by present area along the normal; edge_moment: value "
                 "by length of edges");
  section.value("edges", edges, "names of edges of a traction or moment");
  section.value("point", point, "length", range::any(), "place of a point load on the reference surface");
  section.value("vector", vector, "force/length, /area or 1", "what acts, by reference length or area");
  section.value("value", value, "force/area or force", "a pressure, positive along the normal, or a moment by length");
  section.choice("release", release, {{"none", PressureRelease::none}, {"by_phase", PressureRelease::by_phase}},
                 "whether a crack lets the pressure out");
}

template <int spacedim>
void LoadParameters::add_to(Loads<spacedim> &loads, double density, const std::string &place) const
{
  const std::string where    = place + ": kind = " + kind;
  const bool        is_value = kind == "pressure" || kind == "edge_moment";
  const bool        on_edges = kind == "traction" || kind == "edge_moment";
  internal::check_given(where,
                        {{"edges", !edges.empty()},
                         {"point", !point.empty()},
                         {"vector", !vector.components.empty()},
                         {"value", value.expression() != "0"},
                         {"release", release != PressureRelease::none}},
                        kind == "traction"     ? std::initializer_list<std::string>{"edges", "vector"}
                        : kind == "point_load" ? std::initializer_list<std::string>{"point", "vector"}
                        : kind == "pressure"   ? std::initializer_list<std::string>{"value"}
                        : on_edges             ? std::initializer_list<std::string>{"edges", "value"}
                                               : std::initializer_list<std::string>{"vector"},
                        kind == "pressure" ? std::initializer_list<std::string>{"release"}
                                           : std::initializer_list<std::string>{});
  if (spacedim == 2 && is_value)
    throw InvalidParameter(where + " acts on shells, but surface.dimension = 2");
  const auto check_size = [&](const std::string &name, std::size_t n) {
    if (n != spacedim)
      throw InvalidParameter(where + ": " + name + " has " + std::to_string(n) + " components, expected " +
                             std::to_string(spacedim));
  };

  const auto coordinate = [](const Point<spacedim> &X, int d) { return d < spacedim ? X[d] : 0.; };
  if (!is_value)
    {
      check_size("vector", vector.components.size());
      const auto field = [f = vector.components, coordinate](const Point<spacedim> &X, double t) -> Point<spacedim> {
        Point<spacedim> value;
        for (int d = 0; d < spacedim; ++d)
          value[d] = f[d](coordinate(X, 0), coordinate(X, 1), coordinate(X, 2), t);
        return value;
      };
      if (kind == "traction")
        for (const auto &edge : edges)
          loads.traction(edge, field);
      else if (kind == "surface_load")
        loads.surface_load(field);
      else if (kind == "gravity")
        loads.surface_load(
            [field, density](const Point<spacedim> &X, double t) -> Point<spacedim> { return density * field(X, t); });
      else
        {
          check_size("point", point.size());
          const Point<spacedim> X = Eigen::Map<const Point<spacedim>>(point.data());
          loads.point_load(X, [field, X](double t) { return field(X, t); });
        }
    }
  else if constexpr (spacedim == 3)
    {
      const auto field = [f = value](const Point<3> &X, double t) { return f(X[0], X[1], X[2], t); };
      if (kind == "pressure")
        loads.pressure(field, release);
      else
        for (const auto &edge : edges)
          loads.edge_moment(edge, field);
    }
}

template void LoadParameters::add_to(Loads<2> &, double, const std::string &) const;
template void LoadParameters::add_to(Loads<3> &, double, const std::string &) const;

} // namespace sherd
