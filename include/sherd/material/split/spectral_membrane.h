#pragma once

#include <sherd/material/koiter.h>
#include <sherd/material/split/bending_share.h>
#include <sherd/material/split/spectral_strain.h>

#include <concepts>

namespace sherd::split
{

/// Split by the principal strains of the mid surface, with a bending law apart: theory B.4 (4).
///
/// The membrane law is inside: St. Venant and Kirchhoff's, from given moduli. Bending is shared in one of three ways:
/// all active, never active, or active in the layers that are stretched as under SurfaceStretch. A split of the change
/// of curvature by its own sign is not offered: that sign depends on the choice of the normal, and a shell has both
/// faces.
template <BendingLaw Bending = material::NoBending>
class SpectralMembrane
{
public:
  /// A membrane.
  /// @throws InvalidParameter  unless the moduli are positive and finite.
  explicit SpectralMembrane(const material::Moduli &moduli) requires std::same_as<Bending, material::NoBending>
      : SpectralMembrane(moduli, {}, BendingPart::active)
  {
  }

  /// A shell whose bending is active as a whole, or not at all.
  /// @throws InvalidParameter  unless the moduli are positive and finite.
  SpectralMembrane(const material::Moduli &moduli, const Bending &bending, const BendingPart part)
      : moduli_(moduli), bending_(bending, part)
  {
    require_valid();
  }

  /// A shell whose bending is active in the stretched layers.
  /// @throws InvalidParameter  for moduli or layers that are not valid.
  SpectralMembrane(const material::Moduli &moduli, const Bending &bending, const LayerSettings &layers)
      : moduli_(moduli), bending_(bending, layers)
  {
    require_valid();
  }

  /// A shell of which everything is known, with bending active in the stretched layers and their default settings.
  /// @throws InvalidParameter  for constants that are not positive and finite.
  explicit SpectralMembrane(const material::Sheet &sheet) requires std::constructible_from<Bending, material::Sheet>
      : SpectralMembrane(sheet.moduli, Bending(sheet), LayerSettings{.thickness = sheet.thickness})
  {
  }

  const Bending       &bending() const { return bending_.bending(); }
  const LayerSettings &layers() const { return bending_.layers(); }
  double               bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double               shear() const { return moduli_.shear; } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    return membrane_response(point.reference.frame, spectral_parts(moduli_, cartesian_strain(point)));
  }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    return bending_.respond(point, respond(static_cast<const SurfacePoint<2> &>(point)));
  }

private:
  void require_valid() const
  {
    material::internal::require_positive_moduli(moduli_, "split by principal strains of the membrane");
  }

  material::Moduli      moduli_;
  BendingShare<Bending> bending_;
};

static_assert(EnergySplit<SpectralMembrane<>, 2> && EnergySplit<SpectralMembrane<material::Koiter>, 3>);

} // namespace sherd::split
