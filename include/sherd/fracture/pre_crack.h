#pragma once

#include <sherd/fracture/crack_density/crack_density.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/fracture/polyline.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace sherd
{

/// Cracks that exist before the first step, theory D.
///
/// An initial phase is not remembered, since the phase equation has no rate: a pre-crack lives in the initial history.
/// H_0 is H_c in a strip of half width 0.26 l0 around the cracks and 0 elsewhere, where H_c would hold a homogeneous
/// body at phi = 1e-3. With elements of l0/2 or smaller the crack then costs 1.00 to 1.03 Gc by unit length wherever it
/// lies on the mesh (at exactly l0/4, rounding would decide over Gauss points on the edge of the strip). Ends are half
/// discs. phase() is the start value for the first Newton iteration, which must not begin at phi = 1 (theory C.2).
///
/// Evaluate it afresh after each refinement before the first step instead of transferring it.
template <int spacedim>
class PreCrack
{
public:
  static constexpr double half_width = .26;  ///< of the strip, in units of l0
  static constexpr double core_phase = 1e-3; ///< phase in the strip if it were homogeneous

  /// @param cracks  possibly none.
  /// @param l0      length scale of the phase field.
  /// @throws InvalidParameter  unless l0 > 0 and finite.
  PreCrack(std::vector<Polyline<spacedim>> cracks, const double l0) : cracks_(std::move(cracks)), l0_(l0)
  {
    if (!(std::isfinite(l0) && l0 > 0.))
      throw InvalidParameter("pre-crack: length scale l0 = " + print(l0) + " must be positive and finite");
  }

  const std::vector<Polyline<spacedim>> &cracks() const { return cracks_; }

  /// Distance of X to the nearest crack; infinite if there is none.
  double distance(const Point<spacedim> &X) const
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto &crack : cracks_)
      nearest = std::min(nearest, sherd::distance(X, crack));
    return nearest;
  }

  /// Whether X lies in the strip in which the initial history is set.
  bool contains(const Point<spacedim> &X) const { return distance(X) <= half_width * l0_; }

  /// Initial history H_0 at X.
  /// @param Gc  toughness at X.
  template <Degradation Function>
  double history(const Point<spacedim> &X, const Function &g, const double Gc) const
  {
    return contains(X) ? homogeneous_history(g, core_phase, Gc, l0_) : 0.;
  }

  /// The same for any density.
  template <Degradation Function, CrackDensity Density>
  double history(const Point<spacedim> &X, const Function &g, const Density &density, const double Gc) const
  {
    return contains(X) ? homogeneous_history(g, density, core_phase, Gc, l0_) : 0.;
  }

  /// Optimal profile of the density around the nearest crack, the start value of the phase at X.
  template <CrackDensity Density>
  double phase(const Point<spacedim> &X, const Density &density) const
  {
    const double d = distance(X);
    return std::isinf(d) ? 1. : density.profile(d / l0_);
  }

private:
  std::vector<Polyline<spacedim>> cracks_;
  double                          l0_;
};

} // namespace sherd
