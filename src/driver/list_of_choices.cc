#include <sherd/driver/list_of_choices.h>

#include <sherd/driver/shape_parameters.h>

namespace sherd
{

std::vector<ChoiceGroup> choice_groups()
{
  ChoiceGroup shapes{"surface.shape", {}};
  ShapeParameters().for_each([&](const std::string &name, auto &, int dimensions, const std::string &meaning) {
    shapes.choices.push_back({name, meaning + (dimensions == 3 ? " (in space)" : "")});
  });
  return {
      shapes,
      {"surface.continuity.method",
       {{"none", "patches are hinged to each other"},
        {"penalty", "angle and slope of the phase kept by penalty"},
        {"lagrange_multiplier", "angle and slope of the phase kept by multipliers, constant on interface elements"}}},
      {"material.split",
       {{"surface_stretch", "change of area active where the surface, or a layer of it, is stretched (the paper's)"},
        {"none", "all elastic energy is active, in compression too"},
        {"spectral_layer", "positive principal strains of every layer"},
        {"spectral_membrane", "positive principal strains of the mid surface, bending apart (bending_part)"},
        {"volumetric_deviatoric_layer", "distortion, and increase of area, of every layer"}}},
      {"material.membrane",
       {{"neo_hooke", "large strains; with none and surface_stretch"},
        {"st_venant_kirchhoff", "small strains; with none, and inside the splits of principal strains and of layers"}}},
      {"material.bending",
       {{"canham", "c/2 tr K^2"}, {"koiter", "plane-stress plate; inside the splits of layers"}, {"none", "plane"}}},
      {"material.bending_part",
       {{"layers", "bending active in the stretched layers"}, {"active", "all active"}, {"passive", "never cracks"}}},
      {"material.constants",
       {{"plane_strain", "E, nu of a solid, by unit thickness"},
        {"plane_stress", "E, nu of a solid, by unit thickness"},
        {"lame", "lambda, mu of a solid in plane strain"},
        {"solid", "E, nu and thickness of a sheet"},
        {"surface", "E [force/length] and nu of the surface; in space its thickness"},
        {"moduli", "K, G of the surface; in space c and thickness"}}},
      {"fracture.crack_density",
       {{"fourth_order", "smooth, needs no boundary condition on the sharp side (the paper's)"},
        {"second_order", "classical, AT2"},
        {"at1", "second order with an elastic limit"}}},
      {"fracture.degradation.function",
       {{"cubic", "nearly linear up to the onset of damage (the paper's)"},
        {"quadratic", "classical, damage from the first load on"},
        {"quartic", "as cubic, onset at half the energy"},
        {"rational", "cohesive cracks, slope m and softening P"}}},
      {"fracture.irreversibility",
       {{"history", "largest active energy so far drives the phase (the paper's)"},
        {"penalty", "energy against healing"},
        {"none", "cracks heal when unloaded"}}},
      {"regions.kind", {{"box", "between two corners"}, {"ball", "around a centre"}}},
      {"supports.kind",
       {{"fix", "component, or all, zero"},
        {"prescribe", "component is a function of time"},
        {"clamp", "position and tangent plane stay"},
        {"prescribe_clamped", "moves without turning"},
        {"symmetry", "edge in a plane of symmetry"},
        {"phase_symmetry", "phase level across an edge"},
        {"clamp_weakly", "clamp by penalty, for any parameter lines"},
        {"symmetry_weakly", "symmetry by penalty"},
        {"phase_symmetry_weakly", "phase level by penalty"},
        {"rotate", "an edge turns by a function of time, by penalty"}}},
      {"loads.kind",
       {{"traction", "force by length of an edge"},
        {"surface_load", "force by reference area"},
        {"gravity", "acceleration times mass"},
        {"point_load", "force at a point"},
        {"pressure", "along the present normal, let out by cracks if wanted"},
        {"edge_moment", "moment by length of an edge"}}},
      {"time.integrator",
       {{"generalized_alpha", "second order under changing steps, damps high frequencies by rho_inf"},
        {"newmark", "trapezoidal rule by default"},
        {"hht", "Hilber, Hughes, Taylor"},
        {"wbz", "Wood, Bossak, Zienkiewicz"},
        {"bathe", "two stages, trapezoidal and backward"},
        {"implicit_midpoint", "no dissipation"},
        {"backward_euler", "first order, strong dissipation"},
        {"quasi_static", "no inertia"},
        {"central_difference", "explicit, with solver explicit"}}},
      {"solver",
       {{"monolithic", "displacement and phase together, full Newton"},
        {"staggered", "alternately, for quasi-static cracks that run unstably"},
        {"explicit", "lumped mass, small steps"},
        {"arc_length", "equilibria without crack growth, through limit points of load and displacement"},
        {"modes", "free vibrations about the state at rest"}}},
  };
}

std::string list_of_choices()
{
  std::string text;
  for (const auto &group : choice_groups())
    {
      text += (text.empty() ? "" : "\n") + group.parameter + "\n";
      for (const auto &choice : group.choices)
        text += "  " + choice.name + std::string(choice.name.size() < 28 ? 28 - choice.name.size() : 1, ' ') +
                choice.line + "\n";
    }
  return text;
}

} // namespace sherd
