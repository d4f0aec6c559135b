#pragma once

namespace sherd
{

/// Which unknowns of each control point a system of equations has: a solver that alternates between displacement and
/// phase assembles, stores and solves only the half that it works on.
enum class Unknowns
{
  all,
  displacement,
  phase
};

/// A part of the fields of a control point, which are its displacements and then its phase: those from first on.
struct FieldRange
{
  int first, count;

  constexpr bool contains(int field) const { return field >= first && field < first + count; }
};

/// The fields that are the unknowns of a part in a space of @p spacedim dimensions.
constexpr FieldRange fields_of(Unknowns part, int spacedim)
{
  return part == Unknowns::all            ? FieldRange{0, spacedim + 1}
         : part == Unknowns::displacement ? FieldRange{0, spacedim}
                                          : FieldRange{spacedim, 1};
}

constexpr bool has_displacement(Unknowns part)
{
  return part != Unknowns::phase;
}

constexpr bool has_phase(Unknowns part)
{
  return part != Unknowns::displacement;
}

} // namespace sherd
