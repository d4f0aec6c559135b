#include <sherd/driver/material_parameters.h>

#include "given.h"

namespace sherd
{

void MaterialParameters::declare(ParameterSection &section)
{
  section.choice("split", split,
                 {"surface_stretch", "none", "spectral_layer", "spectral_membrane", "volumetric_deviatoric_layer"},
                 "what of the elastic energy is degraded and drives cracks");
  section.choice("membrane", membrane, {"default", "neo_hooke", "st_venant_kirchhoff"}, "membrane law");
  section.choice("bending", bending, {"default", "canham", "koiter", "none"}, "bending law of a shell; none: plane");
  section.choice(
      "bending_part", bending_part,
      {{"layers", BendingTreatment::layers},
       {"active", BendingTreatment::active},
       {"passive", BendingTreatment::passive}},
      "what of bending is active under surface_stretch and spectral_membrane: the stretched layers, all, nothing");
  section.choice("layer_metric", layers.metric, {{"full", LayerMetric::full}, {"linear", LayerMetric::linear}},
                 "metric of a layer, for splits that look for stretched layers");
  section.choice("cut", layers.cut, {{"frozen", Cut::frozen}, {"kept", Cut::kept}},
                 "whether the moving boundary between stretched and compressed layers gives a stress");
  section.choice("cut_tangent", layers.tangent, {{"full", CutTangent::full}, {"dropped", CutTangent::dropped}},
                 "whether the tangent follows that boundary");
  section.value("layer_points", layer_points, range::at_least(0),
                "Gauss points in the thickness; 0: closed form, or 5 for spectral_layer");
  section.choice("constants", constants,
                 {{"plane_strain", Constants::plane_strain},
                  {"plane_stress", Constants::plane_stress},
                  {"lame", Constants::lame},
                  {"solid", Constants::solid},
                  {"surface", Constants::surface},
                  {"moduli", Constants::moduli}},
                 "which constants are given: youngs_modulus and poissons_ratio of a solid by unit thickness "
                 "(plane_strain, plane_stress) or of a sheet of it (solid, with thickness), of the surface (surface), "
                 "first_lame and shear_modulus (lame, plane strain), or bulk_modulus and shear_modulus (moduli)");
  section.value("youngs_modulus", youngs_modulus, "force/area or /length", range::positive(), "Young's modulus");
  section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 1.), "Poisson's ratio");
  section.value("first_lame", first_lame, "force/area", range::any(), "Lame's first constant");
  section.value("bulk_modulus", bulk_modulus, "force/length", range::positive(), "K of the surface");
  section.value("shear_modulus", shear_modulus, "force/length or /area", range::positive(), "G");
  section.value("bending_modulus", bending_modulus, "force*length", range::positive(),
                "c or D of a shell; none: that of a solid sheet, (K + G) T^2 / 12");
  section.value("thickness", thickness, "length", range::positive(), "thickness T");
  section.value("density", density, "mass/area", range::positive(), "mass by reference area");
  section.value("stiffness", stiffness, "-", "factor of all moduli by position");
}

void MaterialParameters::resolve(int dimension)
{
  const bool shell    = dimension == 3;
  const bool has_laws = split == "none" || split == "surface_stretch";
  const auto choose   = [&](const std::string &name, std::string &law, const std::string &otherwise,
                          std::initializer_list<std::string> accepted) {
    if (law == "default")
      law = otherwise;
    std::string list;
    bool        known = false;
    for (const auto &other : accepted)
      {
        list += (list.empty() ? "" : ", ") + other;
        known |= other == law;
      }
    if (!known)
      throw InvalidParameter("material." + name + " = " + law + ", but material.split = " + split +
                               (shell ? " in space" : " in the plane") + " takes " + list);
  };

  if (split == "none")
    choose("membrane", membrane, "neo_hooke", {"neo_hooke", "st_venant_kirchhoff"});
  else if (split == "surface_stretch")
    choose("membrane", membrane, "neo_hooke", {"neo_hooke"});
  else
    choose("membrane", membrane, "st_venant_kirchhoff", {"st_venant_kirchhoff"});

  if (!shell)
    choose("bending", bending, "none", {"none"});
  else if (has_laws)
    choose("bending", bending, membrane == "neo_hooke" ? "canham" : "koiter", {"canham", "koiter"});
  else if (split == "spectral_membrane")
    choose("bending", bending, "koiter", {"canham", "koiter"});
  else
    choose("bending", bending, "koiter", {"koiter"});

  const bool shares_bending = shell && (split == "surface_stretch" || split == "spectral_membrane");
  if (bending_part != BendingTreatment::layers && !shares_bending)
    throw InvalidParameter("material.bending_part is given, but material.split = " + split +
                           (shell ? "" : " in the plane") +
                           "; only surface_stretch and spectral_membrane in space have a choice of what of bending is "
                           "active");
  const bool          looks_at_layers = shares_bending && bending_part == BendingTreatment::layers;
  const LayerSettings defaults;
  if (!looks_at_layers &&
      (layers.metric != defaults.metric || layers.cut != defaults.cut || layers.tangent != defaults.tangent))
    throw InvalidParameter("material: layer_metric, cut and cut_tangent belong to splits that look for stretched " +
                           std::string("layers, surface_stretch and spectral_membrane in space; this is split = ") +
                           split + (shell ? "" : " in the plane") + "; leave them out");
  if (layer_points != 0 && !looks_at_layers && !(shell && split == "spectral_layer"))
    throw InvalidParameter("material.layer_points is given, but material.split = " + split +
                           (shell ? "" : " in the plane") + " does not integrate over the thickness; leave it out");
  check_constants(dimension);
}

void MaterialParameters::check_constants(int dimension) const
{
  const auto check = [&](const std::string &name, const std::initializer_list<std::string> &needed,
                         const std::initializer_list<std::string> &allowed = {}) {
    internal::check_given("material: constants = " + name,
                          {{"youngs_modulus", youngs_modulus.has_value()},
                           {"poissons_ratio", poissons_ratio.has_value()},
                           {"first_lame", first_lame.has_value()},
                           {"bulk_modulus", bulk_modulus.has_value()},
                           {"shear_modulus", shear_modulus.has_value()},
                           {"bending_modulus", bending_modulus.has_value()},
                           {"thickness", thickness.has_value()}},
                          needed, allowed);
  };
  const auto plane_only = [&](const std::string &name, const std::string &instead) {
    if (dimension == 3)
      throw InvalidParameter("material: constants = " + name + ", but surface.dimension = 3; a shell takes " + instead);
  };
  switch (constants)
    {
    case Constants::plane_strain:
      plane_only("plane_strain", "solid, surface or moduli");
      return check("plane_strain", {"youngs_modulus", "poissons_ratio"});
    case Constants::plane_stress:
      plane_only("plane_stress", "solid, which is in plane stress and has a thickness");
      return check("plane_stress", {"youngs_modulus", "poissons_ratio"});
    case Constants::lame:
      plane_only("lame", "solid, surface or moduli");
      return check("lame", {"first_lame", "shear_modulus"});
    case Constants::solid:
      if (dimension == 3)
        return check("solid", {"youngs_modulus", "poissons_ratio", "thickness"}, {"bending_modulus"});
      return check("solid", {"youngs_modulus", "poissons_ratio", "thickness"});
    case Constants::surface:
      if (dimension == 3)
        return check("surface", {"youngs_modulus", "poissons_ratio", "thickness"}, {"bending_modulus"});
      return check("surface", {"youngs_modulus", "poissons_ratio"});
    case Constants::moduli:
      if (dimension == 3)
        return check("moduli", {"bulk_modulus", "shear_modulus", "thickness"}, {"bending_modulus"});
      return check("moduli", {"bulk_modulus", "shear_modulus"});
    }
}

} // namespace sherd
