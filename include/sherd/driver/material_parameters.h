#pragma once

#include <optional>
#include <string>

#include <sherd/base/parameter_section.h>
#include <sherd/material/split/layer_settings.h>

namespace sherd
{

/// Which elastic constants a case file gives, theory B.3.
enum class Constants
{
  plane_strain, ///< E, nu of a solid, by unit thickness
  plane_stress, ///< the same in plane stress
  lame,         ///< lambda, mu of a solid in plane strain
  solid,        ///< E, nu of a solid and its thickness: a sheet
  surface,      ///< E, nu of the surface, E [force/length]; in space the thickness
  moduli        ///< K, G of the surface; in space c and the thickness
};

/// What is looked at of bending by splits that take a bending law.
enum class BendingTreatment
{
  layers, ///< active in the stretched layers
  active,
  passive
};

/// Elastic constants, energy split and laws of a case.
struct MaterialParameters
{
  std::string           split        = "surface_stretch";
  std::string           membrane     = "default";
  std::string           bending      = "default";
  BendingTreatment      bending_part = BendingTreatment::layers;
  LayerSettings         layers;
  int                   layer_points = 0;
  Constants             constants    = Constants::surface;
  std::optional<double> youngs_modulus, poissons_ratio, first_lame, bulk_modulus, shear_modulus, bending_modulus,
      thickness;
  double  density   = 1.;
  Formula stiffness = Formula("1", {"x", "y", "z"});

  void declare(ParameterSection &section);

  /// Puts the names of the laws in the place of `default`. @param dimension   2: plane, no bending; 3: shell
  /// @throws InvalidParameter   a law that the split does not accept; constants that are missing, or given in vain
  void resolve(int dimension);

private:
  void check_constants(int dimension) const;
};

} // namespace sherd
