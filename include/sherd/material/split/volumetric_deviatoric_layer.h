#pragma once

#include <sherd/material/sheet.h>
#include <sherd/material/split/layer_moments.h>

#include <algorithm>
#include <cmath>

namespace sherd::split
{

namespace internal
{
/// Strain energy K/2 <tr E>^2 + G dev E : dev E, theory B.4 (5).
inline StrainParts volumetric_deviatoric_parts(const material::Moduli &moduli, const Voigt &E)
{
  const double trace = E[0] + E[1], half = .5 * (E[0] - E[1]), G = moduli.shear;
  StrainParts  parts = StrainParts::zero();
  parts.active       = {2. * G * (half * half + E[2] * E[2]),
                        {2. * G * half, -2. * G * half, 2. * G * E[2]},
                        Voigt4{{G, -G, 0.}, {-G, G, 0.}, {0., 0., G}}};
  auto &part         = trace >= -strain_tolerance ? parts.active : parts.passive;
  part.energy += .5 * moduli.bulk * trace * trace;
  part.stress.head<2>().array() += moduli.bulk * trace;
  part.tangent.topLeftCorner<2, 2>().array() += moduli.bulk;
  return parts;
}
} // namespace internal

/// Split into change of area and distortion, of every layer of a shell: theory B.4 (5), after Amor et al. (2009).
///
///   psi+ = K/2 <tr E>+^2 + G dev E : dev E,   psi- = K/2 <tr E>-^2
///
/// The law is inside: St. Venant and Kirchhoff's in plane stress, whose parts sum to Koiter's shell. The trace is
/// linear in the thickness, so that the integral over the layers is closed. Trace and deviator are those of the plane
/// tensor, in plane strain too.
///
/// @tparam spacedim  2: a membrane in the plane, one layer; 3: a shell.
template <int spacedim>
class VolumetricDeviatoricLayer;

template <>
class VolumetricDeviatoricLayer<2>
{
public:
  /// @param moduli  from surface_moduli(), plane_stress_moduli() or plane_strain_moduli().
  /// @throws InvalidParameter  unless both are positive and finite.
  explicit VolumetricDeviatoricLayer(const material::Moduli &moduli) : moduli_(moduli)
  {
    material::internal::require_positive_moduli(moduli, "volumetric-deviatoric split");
  }

  double bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double shear() const { return moduli_.shear; } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    return membrane_response(point.reference.frame,
                             internal::volumetric_deviatoric_parts(moduli_, cartesian_strain(point)));
  }

private:
  material::Moduli moduli_;
};

template <>
class VolumetricDeviatoricLayer<3>
{
public:
  /// @param moduli     of the surface, K and G [force/length].
  /// @param thickness  T [length].
  /// @throws InvalidParameter  unless all are positive and finite.
  VolumetricDeviatoricLayer(const material::Moduli &moduli, const double thickness)
      : VolumetricDeviatoricLayer(material::Sheet{moduli, material::solid_rigidity(moduli, thickness), thickness})
  {
  }

  /// @throws InvalidParameter  also where the bending modulus is not that of a solid sheet.
  explicit VolumetricDeviatoricLayer(const material::Sheet &sheet) : moduli_(sheet.moduli), thickness_(sheet.thickness)
  {
    material::require_solid(sheet, "volumetric-deviatoric split of layers");
  }

  double bulk() const { return moduli_.bulk; }   ///< K [force/length]
  double shear() const { return moduli_.shear; } ///< G [force/length]
  double thickness() const { return thickness_; }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    const LayerStrain strain(point, thickness_);
    LayerMoments      active, passive;

    // Distortion is active in all layers: 1/2 int (1, s, s^2) ds = (1, 0, 1/3).
    const double G          = moduli_.shear;
    const auto   distortion = [G](const Voigt &E) {
      const double half = .5 * (E[0] - E[1]);
      return Voigt(2. * G * half, -2. * G * half, 2. * G * E[2]);
    };
    active.stress     = {distortion(strain.membrane), distortion(strain.bending) / 3.};
    active.energy     = .5 * (contract(active.stress[0], strain.membrane) + contract(active.stress[1], strain.bending));
    active.tangent[0] = Voigt4{{G, -G, 0.}, {-G, G, 0.}, {0., 0., G}};
    active.tangent[2] = active.tangent[0] / 3.;

    // The trace changes its sign at one layer at most.
    const double middle = strain.membrane[0] + strain.membrane[1], slope = strain.bending[0] + strain.bending[1];
    if (middle - std::abs(slope) >= -strain_tolerance)
      add_dilatation(-1., 1., middle - slope, middle + slope, active);
    else if (middle + std::abs(slope) < -strain_tolerance)
      add_dilatation(-1., 1., middle - slope, middle + slope, passive);
    else
      {
        const double cut = std::clamp(-middle / slope, -1., 1.);
        add_dilatation(-1., cut, middle - slope, 0., slope > 0. ? passive : active);
        add_dilatation(cut, 1., 0., middle + slope, slope > 0. ? active : passive);
      }
    return shell_response(point.reference.frame, active, passive, thickness_);
  }

private:
  /// Adds K/2 (tr E)^2 of the layers from @p low to @p high, where the trace runs from @p first to @p last, by exact
  /// integrals of products of linear functions.
  void add_dilatation(const double low, const double high, const double first, const double last,
                      LayerMoments &part) const
  {
    const double K = moduli_.bulk, share = .5 * (high - low);
    part.energy += K / 6. * share * (first * first + first * last + last * last);
    const double pressure = .5 * K * share * (first + last);
    const double turning  = K / 6. * share * (2. * low * first + low * last + high * first + 2. * high * last);
    part.stress[0].head<2>().array() += pressure;
    part.stress[1].head<2>().array() += turning;
    const std::array<double, 3> moments{1., .5 * (low + high), (low * low + low * high + high * high) / 3.};
    for (int n = 0; n < 3; ++n)
      part.tangent[n].topLeftCorner<2, 2>().array() += K * share * moments[n];
  }

  material::Moduli moduli_;
  double           thickness_;
};

VolumetricDeviatoricLayer(material::Moduli)->VolumetricDeviatoricLayer<2>;
VolumetricDeviatoricLayer(material::Moduli, double)->VolumetricDeviatoricLayer<3>;
VolumetricDeviatoricLayer(material::Sheet)->VolumetricDeviatoricLayer<3>;

static_assert(EnergySplit<VolumetricDeviatoricLayer<2>, 2> && EnergySplit<VolumetricDeviatoricLayer<3>, 3>);

} // namespace sherd::split
