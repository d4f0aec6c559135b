#pragma once

#include <sherd/material/bending.h>
#include <sherd/material/sheet.h>
#include <sherd/material/split/gauss_thickness.h>
#include <sherd/material/split/layer_settings.h>
#include <sherd/material/split/split.h>
#include <sherd/material/split/weight_derivatives.h>

#include <concepts>
#include <optional>

namespace sherd
{

/// The part of the energy that all of bending belongs to, where layers are not looked at.
enum class BendingPart
{
  active, ///< bending is degraded and drives cracks whatever its sign, as without a split
  passive ///< bending never cracks, and an open crack keeps its bending stiffness
};

/// Shares the energy of a bending law between active and passive part, Psi_b+ = w Psi_b and Psi_b- = (1 - w) Psi_b
/// (theory B.4 (2) and (4)).
///
/// w is 1, 0 or the weight of the layers that are stretched, thickness_weight(). With a frozen cut, the default,
///
///   M+ = w M_b,   f+ = w f_b + M_b (x) w_b,   e+ = 2 M_b (x) w_a,   driving = (tau+ + 2 Psi_b w_a, M+ + Psi_b w_b)
///
/// and with a kept one stress and driving are the same and the tangent is their derivative. Passive parts have 1 - w.
template <BendingLaw Bending>
class BendingShare
{
public:
  BendingShare(const Bending &bending, const BendingPart part)
      : bending_(bending), fixed_weight_(part == BendingPart::active ? 1. : 0.)
  {
  }

  /// @throws InvalidParameter  for layers that are not valid.
  BendingShare(const Bending &bending, const LayerSettings &layers)
      : bending_(bending), layers_(layers), looks_at_layers_(true)
  {
    require_valid(layers);
    if (layers.n_points > 0)
      gauss_.emplace(layers.n_points);
  }

  const Bending       &bending() const { return bending_; }
  const LayerSettings &layers() const { return layers_; }

  /// The response of a membrane and that of its bending.
  SplitResponse<3> respond(const SurfacePoint<3> &point, const SplitResponse<2> &membrane) const
  {
    const BendingResponse bending = bending_.bend(point);
    LayerStretch          stretch{};
    ThicknessWeight       weight{fixed_weight_, 0, {}};
    if (looks_at_layers_)
      {
        stretch = layer_stretch(point, layers_.thickness, layers_.metric);
        weight  = gauss_ ? ThicknessWeight{gauss_->weight(stretch), 0, {}} : thickness_weight(stretch);
      }

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

  [[no_unique_address]] Bending bending_;
  LayerSettings                 layers_;
  std::optional<GaussThickness> gauss_;
  bool                          looks_at_layers_ = false;
  double                        fixed_weight_    = 0.; ///< where it does not
};

} // namespace sherd
