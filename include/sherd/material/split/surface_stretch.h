#pragma once

#include <sherd/material/bending.h>
#include <sherd/material/neo_hooke.h>
#include <sherd/material/split/gauss_thickness.h>
#include <sherd/material/split/layer_settings.h>
#include <sherd/material/split/split.h>
#include <sherd/material/split/weight_derivatives.h>

#include <concepts>
#include <optional>

namespace sherd::split
{

/// Split by the sign of the surface stretch less 1, theory B.4 (2); paper Eqs. (10) and (11).
///
/// Membrane: distortion is always active, change of area only where the surface is stretched, J >= 1. Energy and stress
/// are continuous at J = 1, where Psi_dil and its stress vanish; the tangent jumps.
///
/// Bending: Psi_b is shared among the layers of the thickness and active in the stretched ones,
/// Psi_b+ = w Psi_b with the weight w of thickness_weight(). With a frozen cut, the default,
///
///   M+ = w M_b,   f+ = w f_b + M_b (x) w_b,   e+ = 2 M_b (x) w_a,   driving = (tau+ + 2 Psi_b w_a, M+ + Psi_b w_b)
///
/// and with a kept one stress and driving are the same and the tangent is their derivative. Passive parts have 1 - w.
template <SeparableMembraneLaw Membrane, BendingLaw Bending = material::NoBending>
class SurfaceStretch
{
public:
  /// J counts as stretched down to 1 minus this, so that rounding does not toggle the stiffness of an unloaded crack.
  static constexpr double tolerance = LayerStretch::tolerance;

  /// A membrane.
  explicit SurfaceStretch(const Membrane &membrane) requires std::same_as<Bending, material::NoBending>
      : membrane_(membrane)
  {
  }

  /// A shell.
  /// @throws InvalidParameter  for layers that are not valid.
  SurfaceStretch(const Membrane &membrane, const Bending &bending, const LayerSettings &layers)
      : membrane_(membrane), bending_(bending), layers_(layers)
  {
    require_valid(layers);
    if (layers.n_points > 0)
      gauss_.emplace(layers.n_points);
  }

  const Membrane      &membrane() const { return membrane_; }
  const Bending       &bending() const { return bending_; }
  const LayerSettings &layers() const { return layers_; }
  double               bulk() const { return membrane_.bulk(); }   ///< K [force/length]
  double               shear() const { return membrane_.shear(); } ///< G [force/length]

  SplitResponse<2> respond(const SurfacePoint<2> &point) const
  {
    const Response<2> dilatation = membrane_.dilatation(point), deviator = membrane_.deviator(point);
    if (point.J_minus_1 < -tolerance)
      return {deviator.energy,  dilatation.energy,  deviator.stress, dilatation.stress,
              deviator.tangent, dilatation.tangent, deviator.stress};
    const Response<2> active = dilatation + deviator;
    return {active.energy, 0., active.stress, Stress<2>::zero(), active.tangent, Tangent<2>::zero(), active.stress};
  }

  SplitResponse<3> respond(const SurfacePoint<3> &point) const
  {
    const SplitResponse<2> membrane = respond(static_cast<const SurfacePoint<2> &>(point));
    const BendingResponse  bending  = bending_.bend(point);
    const LayerStretch     stretch  = layer_stretch(point, layers_.thickness, layers_.metric);
    const ThicknessWeight weight = gauss_ ? ThicknessWeight{gauss_->weight(stretch), 0, {}} : thickness_weight(stretch);

    const double     w    = weight.value;
    const Voigt4     zero = Voigt4::Zero();
    const Stress<3>  stress{membrane.stress_active.membrane, w * bending.moment};
    SplitResponse<3> response{membrane.energy_active + w * bending.energy,
                              membrane.energy_passive + (1. - w) * bending.energy,
                              stress,
                              {membrane.stress_passive.membrane, (1. - w) * bending.moment},
                              {membrane.tangent_active.membrane, zero, zero, w * bending.stiffness},
                              {membrane.tangent_passive.membrane, zero, zero, (1. - w) * bending.stiffness},
                              stress};
    if (weight.n_cuts > 0)
      add_cuts(point, bending, stretch, weight, response);
    return response;
  }

private:
  /// Terms with derivatives of the weight; all zero where nothing is cut.
  void add_cuts(const SurfacePoint<3> &point, const BendingResponse &bending, const LayerStretch &stretch,
                const ThicknessWeight &weight, SplitResponse<3> &response) const
  {
    const auto      q = layer_stretch_gradient(point, layers_.thickness, layers_.metric);
    const auto      w = weight_gradient(weight, stretch, q);
    const Stress<3> moving{2. * bending.energy * w.a, bending.energy * w.b};
    response.driving = response.driving + moving;
    if (layers_.cut == Cut::kept)
      {
        response.stress_active  = response.driving;
        response.stress_passive = response.stress_passive + -1. * moving;
      }
    if (layers_.tangent == CutTangent::dropped)
      return;

    const Voigt4 M_b     = bending.moment * w.b.transpose();
    Tangent<3>   tangent = Tangent<3>::zero();
    if (layers_.cut == Cut::frozen)
      {
        tangent.moment_coupling = 2. * bending.moment * w.a.transpose();
        tangent.bending         = M_b;
      }
    else
      {
        const auto ww =
            weight_hessian(weight, stretch, q, layer_stretch_hessian(point, layers_.thickness, layers_.metric));
        tangent.membrane        = 4. * bending.energy * ww.aa;
        tangent.coupling        = 2. * (w.a * bending.moment.transpose() + bending.energy * ww.ab);
        tangent.moment_coupling = tangent.coupling.transpose();
        tangent.bending         = M_b + M_b.transpose() + bending.energy * ww.bb;
      }
    response.tangent_active  = response.tangent_active + tangent;
    response.tangent_passive = response.tangent_passive + -1. * tangent;
  }

  Membrane                      membrane_;
  [[no_unique_address]] Bending bending_;
  LayerSettings                 layers_;
  std::optional<GaussThickness> gauss_;
};

static_assert(EnergySplit<SurfaceStretch<material::NeoHooke>, 2> && EnergySplit<SurfaceStretch<material::NeoHooke>, 3>);

} // namespace sherd::split
