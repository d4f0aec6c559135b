#pragma once

#include <sherd/material/sheet.h>
#include <sherd/material/split/layer_moments.h>
#include <sherd/material/split/spectral_strain.h>
#include <sherd/material/split/thickness_rule.h>

namespace sherd::split
{

/// Split by the principal strains, of every layer of a shell: theory B.4 (3), after Kiendl et al. (2016).
///
/// The law is inside: St. Venant and Kirchhoff's in plane stress, whose parts sum to Koiter's shell. Active is what
/// principal strains and the trace of the strain have in tension. A shell couples membrane and bending: where the
/// layers under tension are broken, the others carry the load off the mid surface.
///
/// @tparam spacedim  2: a membrane in the plane, one layer; 3: a shell.
template <int spacedim>
class SpectralLayer;

template <>
class SpectralLayer<2>
{
public:
  /// @param moduli  from surface_moduli(), plane_stress_moduli() or plane_strain_moduli().
  /// @throws InvalidParameter  unless both are positive and finite.
  explicit SpectralLayer(const material::Moduli &moduli) : moduli_(moduli)
  {
    material::internal::require_positive_moduli(moduli, "split by principal strains");
  }

  double bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double shear() const { return moduli_.shear; } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    return membrane_response(point.reference.frame, spectral_parts(moduli_, cartesian_strain(point)));
  }

private:
  material::Moduli moduli_;
};

template <>
class SpectralLayer<3>
{
public:
  /// The error of the active energy in combined tension and bending is 2.2 % with 3 points, 0.40 % with 5 and 0.035 %
  /// with 7 (theory B.4 (3)); with any rule stress and tangent are exact derivatives of the energy.
  static constexpr int default_n_points = 5;

  /// @param moduli     of the surface, K and G [force/length].
  /// @param thickness  T [length].
  /// @param n_points   Gauss points in the thickness, at least 2.
  /// @throws InvalidParameter  for values outside these ranges.
  SpectralLayer(const material::Moduli &moduli, const double thickness, const int n_points = default_n_points)
      : SpectralLayer(material::Sheet{moduli, material::solid_rigidity(moduli, thickness), thickness}, n_points)
  {
  }

  /// @throws InvalidParameter  also where the bending modulus is not that of a solid sheet.
  explicit SpectralLayer(const material::Sheet &sheet, const int n_points = default_n_points)
      : moduli_(sheet.moduli), thickness_(sheet.thickness), rule_(n_points, "split by principal strains of layers")
  {
    material::require_solid(sheet, "split by principal strains of layers");
  }

  double bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double shear() const { return moduli_.shear; } ///< G [force/length]
  double thickness() const { return thickness_; }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    const LayerStrain strain(point, thickness_);
    LayerMoments      active, passive;
    for (std::size_t g = 0; g < rule_.points.size(); ++g)
      {
        const double      s     = rule_.points[g];
        const StrainParts parts = spectral_parts(moduli_, strain.at(s));
        active.add(parts.active, s, .5 * rule_.weights[g]);
        passive.add(parts.passive, s, .5 * rule_.weights[g]);
      }
    return shell_response(point.reference.frame, active, passive, thickness_);
  }

private:
  material::Moduli moduli_;
  double           thickness_;
  ThicknessRule    rule_;
};

SpectralLayer(material::Moduli)->SpectralLayer<2>;
SpectralLayer(material::Moduli, double)->SpectralLayer<3>;
SpectralLayer(material::Moduli, double, int)->SpectralLayer<3>;
SpectralLayer(material::Sheet)->SpectralLayer<3>;
SpectralLayer(material::Sheet, int)->SpectralLayer<3>;

static_assert(EnergySplit<SpectralLayer<2>, 2> && EnergySplit<SpectralLayer<3>, 3>);

} // namespace sherd::split
