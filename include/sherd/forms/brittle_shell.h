#pragma once

#include <cmath>
#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/fracture/crack_density/crack_density.h>
#include <sherd/fracture/degradation/degradation.h>
#include <sherd/fracture/irreversibility/history.h>
#include <sherd/fracture/toughness.h>
#include <sherd/material/split/split.h>
#include <sherd/material/stiffness_field.h>

namespace sherd
{

/// A brittle shell: everything that acts at a quadrature point, bundled. Its energy by reference area is
///
///   Psi = g(phi) Psi+ + Psi- + Gc/(4 l0) [w(phi) + c1 |grad phi|^2 + c2 (lap phi)^2]
///
/// with w = (phi - 1)^2 for the crack densities of second and fourth order, and with the driving energy of the
/// irreversibility, the history H, in place of Psi+ where it drives the phase. Where the surface is inhomogeneous, Psi+
/// and Psi- are those of the split times a factor by position.
///
/// @tparam degree    of the splines
/// @tparam spacedim  2: a membrane in the plane; 3: a shell in space
///
/// Source: theory B.4, E; paper Eqs. (5), (6), (9).
template <int degree_, int spacedim_, EnergySplit<spacedim_> Split, Degradation DegradationFunction,
          CrackDensity Density, Irreversibility IrreversibilityRule = irreversibility::History>
struct BrittleShell
{
  static constexpr int degree   = degree_;
  static constexpr int spacedim = spacedim_;
  static constexpr int n_fields = fields_per_point<spacedim>;

  Split                    split;
  DegradationFunction      degradation;
  Density                  crack_density;
  IrreversibilityRule      irreversibility;
  Toughness<spacedim>      toughness;    ///< Gc(X) [energy/length]
  StiffnessField<spacedim> stiffness;    ///< factor(X) of the moduli of the split
  double                   length_scale; ///< l0 [length]
  double                   mass;         ///< rho, mass by reference area

  /// @throws InvalidParameter   unless length_scale and mass are positive and finite
  BrittleShell(Split split_, DegradationFunction degradation_, Density crack_density_, Toughness<spacedim> toughness_,
               double length_scale_, double mass_, IrreversibilityRule irreversibility_ = {},
               StiffnessField<spacedim> stiffness_ = {})
      : split(std::move(split_)),
        degradation(std::move(degradation_)),
        crack_density(std::move(crack_density_)),
        irreversibility(std::move(irreversibility_)),
        toughness(std::move(toughness_)),
        stiffness(std::move(stiffness_)),
        length_scale(length_scale_),
        mass(mass_)
  {
    require_positive(length_scale, "length scale l0");
    require_positive(mass, "mass by area rho");
  }

private:
  static void require_positive(double value, const std::string &name)
  {
    if (!(std::isfinite(value) && value > 0.))
      throw InvalidParameter("brittle shell: " + name + " = " + std::to_string(value) +
                             ", expected a positive finite value");
  }
};

} // namespace sherd
