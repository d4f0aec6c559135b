#pragma once

#include <vector>

#include <sherd/driver/case.h>
#include <sherd/forms/brittle_shell.h>
#include <sherd/fracture/pre_crack.h>
#include <sherd/geometry/surface.h>
#include <sherd/material/split/any.h>

namespace sherd
{

/// The model of a case: everything that can be chosen by name is chosen at run time, so that one compiled kernel for
/// each degree and dimension serves all of them, and splits of a user too.
template <int degree, int spacedim>
using CaseModel =
    BrittleShell<degree, spacedim, split::Any<spacedim>, degradation::Any, crack_density::Any, irreversibility::Any>;

/// The split of a case with its laws.
/// @pre names resolved (MaterialParameters::resolve)
/// @throws InvalidParameter   from split and laws
template <int spacedim>
split::Any<spacedim> make_split(const MaterialParameters &parameters);
template <>
split::Any<2> make_split(const MaterialParameters &parameters);
template <>
split::Any<3> make_split(const MaterialParameters &parameters);

/// Toughness and stiffness of a case by position.
/// @throws InvalidParameter   a region that lacks what its kind needs
template <int spacedim>
Toughness<spacedim> make_toughness(const Case &prm);
template <int spacedim>
StiffnessField<spacedim> make_stiffness(const Case &prm);

/// All together.
template <int degree, int spacedim>
CaseModel<degree, spacedim> make_model(const Case &prm)
{
  return {make_split<spacedim>(prm.material),  prm.fracture.degradation.make(), prm.fracture.make_crack_density(),
          make_toughness<spacedim>(prm),       prm.fracture.length_scale,       prm.material.density,
          prm.fracture.make_irreversibility(), make_stiffness<spacedim>(prm)};
}

/// The cracks of a case; those that are to be on the surface are moved to its closest points.
/// @throws InvalidParameter   a point without @p spacedim coordinates; from Polyline
template <int degree, int spacedim>
PreCrack<spacedim> make_cracks(const Case &prm, const Surface<degree, spacedim> &surface);

/// The lines of Case::fine_mesh; as make_cracks.
template <int degree, int spacedim>
std::vector<Polyline<spacedim>> make_fine_lines(const Case &prm, const Surface<degree, spacedim> &surface);

} // namespace sherd
