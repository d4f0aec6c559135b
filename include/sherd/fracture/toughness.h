#pragma once

#include <sherd/base/positive_field.h>

#include <concepts>
#include <type_traits>
#include <utility>

namespace sherd
{

/// Fracture toughness Gc [energy/length] as a field on the reference surface: a constant or a function of position.
template <int spacedim>
class Toughness : public PositiveField<spacedim>
{
public:
  /// @throws InvalidParameter  unless @p constant is positive and finite.
  Toughness(const double constant) : PositiveField<spacedim>("fracture toughness", constant) {}

  /// @param field  Gc(X), or Gc(x, y), Gc(x, y, z): a function or formula of the reference position.
  template <internal::FunctionOfPosition<spacedim> Field>
  requires(!std::same_as<std::remove_cvref_t<Field>, Toughness>) Toughness(Field &&field)
      : PositiveField<spacedim>("fracture toughness", std::forward<Field>(field))
  {
  }
};

} // namespace sherd
