#include <sherd/space/supports.h>

namespace sherd
{

namespace
{

double zero(double)
{
  return 0.;
}

} // namespace

void Supports::fix(Region region, Component component)
{
  supports_.push_back({std::move(region), component, Rows::first, zero, true});
}

void Supports::fix(Region region)
{
  supports_.push_back({std::move(region), {}, Rows::first, zero, true});
}

void Supports::prescribe(Region region, Component component, std::function<double(double)> displacement)
{
  supports_.push_back({std::move(region), component, Rows::first, std::move(displacement)});
}

void Supports::clamp(const std::string &edge)
{
  supports_.push_back({edge, {}, Rows::first_second, zero, true});
}

void Supports::prescribe_clamped(const std::string &edge, Component component,
                                 std::function<double(double)> displacement)
{
  supports_.push_back({edge, component, Rows::first_second, std::move(displacement)});
}

void Supports::symmetry(const std::string &edge, Component normal)
{
  fix(edge, normal);
  symmetries_.push_back({edge, normal});
}

void Supports::phase_symmetry(const std::string &edge)
{
  symmetries_.push_back({edge, {}});
}

void Supports::clamp_weakly(const std::string &edge, const continuity::Penalty &factors)
{
  fix(edge);
  rotate(edge, zero, factors);
}

void Supports::rotate(const std::string &edge, std::function<double(double)> angle, const continuity::Penalty &factors)
{
  weak_edges_.push_back({edge, WeakEdge::HeldNormal{std::move(angle)}, factors.deformation});
}

void Supports::symmetry_weakly(const std::string &edge, Component normal, const continuity::Penalty &factors)
{
  fix(edge, normal);
  weak_edges_.push_back({edge, WeakEdge::SymmetricNormal{normal}, factors.deformation});
  phase_symmetry_weakly(edge, factors);
}

void Supports::phase_symmetry_weakly(const std::string &edge, const continuity::Penalty &factors)
{
  weak_edges_.push_back({edge, WeakEdge::LevelPhase{}, factors.phase});
}

int component_index(Component component, int spacedim, const std::string &where)
{
  const int index = static_cast<int>(component);
  if (index >= 0 && index < spacedim)
    return index;
  const std::string names = "xyz";
  const std::string given = index >= 0 && index < 3 ? std::string(1, names[index]) : std::to_string(index);
  throw InvalidParameter("support of " + where + ": there is no component " + given + ", the surface lies in " +
                         std::to_string(spacedim) + " dimensions; expected " +
                         (spacedim == 2 ? "x or y" : "x, y or z"));
}

} // namespace sherd
