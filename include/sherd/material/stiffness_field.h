#pragma once

#include <sherd/base/positive_field.h>

#include <concepts>
#include <type_traits>
#include <utility>

namespace sherd
{

/// Stiffness of an inhomogeneous surface by position: the factor, 1 where nothing is said, of K, G and c alike. All
/// elastic energies, stresses and tangents scale with it (operator* of SplitResponse).
///
/// It describes a Young's modulus that varies and a Poisson's ratio that does not, E(X) = factor(X) E.
template <int spacedim>
class StiffnessField : public PositiveField<spacedim>
{
public:
  /// @throws InvalidParameter  unless @p constant is positive and finite.
  StiffnessField(const double constant = 1.) : PositiveField<spacedim>("stiffness factor", constant) {}

  /// @param field  factor(X), or factor(x, y), factor(x, y, z): a function or formula of the reference position.
  template <internal::FunctionOfPosition<spacedim> Field>
  requires(!std::same_as<std::remove_cvref_t<Field>, StiffnessField>) StiffnessField(Field &&field)
      : PositiveField<spacedim>("stiffness factor", std::forward<Field>(field))
  {
  }
};

} // namespace sherd
