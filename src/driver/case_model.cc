#include <sherd/driver/case_model.h>

#include <numbers>

#include <sherd/geometry/place.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_layer.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>

namespace sherd
{
namespace
{

material::Moduli moduli_of(const MaterialParameters &p)
{
  switch (p.constants)
    {
    case Constants::plane_strain:
      return material::plane_strain_moduli(*p.youngs_modulus, *p.poissons_ratio);
    case Constants::plane_stress:
      return material::plane_stress_moduli(*p.youngs_modulus, *p.poissons_ratio, 1.);
    case Constants::lame:
      return {*p.first_lame + *p.shear_modulus, *p.shear_modulus};
    case Constants::solid:
      return material::plane_stress_moduli(*p.youngs_modulus, *p.poissons_ratio, *p.thickness);
    case Constants::surface:
      return material::surface_moduli(*p.youngs_modulus, *p.poissons_ratio);
    case Constants::moduli:
      break;
    }
  return {*p.bulk_modulus, *p.shear_modulus};
}

material::Sheet sheet_of(const MaterialParameters &p)
{
  const auto   moduli  = moduli_of(p);
  const double bending = p.bending_modulus ? *p.bending_modulus : material::solid_rigidity(moduli, *p.thickness);
  return material::sheet_by_moduli(moduli.bulk, moduli.shear, bending, *p.thickness);
}

LayerSettings layers_of(const MaterialParameters &p)
{
  auto layers      = p.layers;
  layers.thickness = *p.thickness;
  layers.n_points  = p.layer_points;
  return layers;
}

template <class Bending>
split::Any<3> make_shell_split(const MaterialParameters &p)
{
  using material::NeoHooke, material::StVenantKirchhoff;
  const auto    sheet = sheet_of(p);
  const Bending bending(sheet);
  if (p.split == "none" && p.membrane == "neo_hooke")
    return split::None<NeoHooke, Bending>(NeoHooke(sheet.moduli), bending);
  if (p.split == "none")
    return split::None<StVenantKirchhoff, Bending>(StVenantKirchhoff(sheet.moduli), bending);
  const auto share = [&](const auto &kind) -> split::Any<3> {
    if (p.split == "surface_stretch")
      return split::SurfaceStretch<NeoHooke, Bending>(NeoHooke(sheet.moduli), bending, kind);
    return split::SpectralMembrane<Bending>(sheet.moduli, bending, kind);
  };
  if (p.bending_part == BendingTreatment::layers)
    return share(layers_of(p));
  return share(p.bending_part == BendingTreatment::active ? BendingPart::active : BendingPart::passive);
}

/// Share of @p X that belongs to the region: 1 inside, 0 outside, a cosine between.
template <int spacedim>
class RegionShare
{
public:
  RegionShare(const RegionParameters &region, const std::string &where)
      : is_box_(region.kind == "box"), transition_(region.transition)
  {
    const auto vector = [&](const std::vector<double> &given, const std::string &name) -> Point<spacedim> {
      if (given.size() != spacedim)
        throw InvalidParameter(where + ": kind = " + region.kind + " needs " + name + " with " +
                               std::to_string(spacedim) + " coordinates, " + std::to_string(given.size()) + " given");
      return Eigen::Map<const Point<spacedim>>(given.data());
    };
    const auto refuse = [&](bool given, const std::string &name) {
      if (given)
        throw InvalidParameter(where + ": kind = " + region.kind + " has no " + name +
                               ", which is given; leave it out");
    };
    if (is_box_)
      {
        refuse(!region.centre.empty(), "centre");
        refuse(region.radius.has_value(), "radius");
        lower_ = vector(region.lower, "lower");
        upper_ = vector(region.upper, "upper");
        if (!(lower_.array() < upper_.array()).all())
          throw InvalidParameter(where +
                                 ": the lower corner of the box is not below the upper one in every coordinate");
        return;
      }
    refuse(!region.lower.empty(), "lower");
    refuse(!region.upper.empty(), "upper");
    lower_ = vector(region.centre, "centre");
    if (!region.radius)
      throw InvalidParameter(where + ": kind = ball needs a radius");
    radius_ = *region.radius;
  }

  double operator()(const Point<spacedim> &X) const
  {
    const double distance = is_box_ ? (lower_ - X).cwiseMax(X - upper_).maxCoeff() : (X - lower_).norm() - radius_;
    if (2. * std::abs(distance) < transition_)
      return .5 * (1. - std::sin(std::numbers::pi * distance / transition_));
    return distance > 0. ? 0. : 1.;
  }

private:
  bool            is_box_;
  Point<spacedim> lower_, upper_;
  double          radius_ = 0., transition_;
};

/// A formula of position times the factors of all regions.
template <int spacedim>
std::function<double(const Point<spacedim> &)> field_of(const Formula &formula, const Case &prm,
                                                        double RegionParameters::*factor)
{
  std::vector<std::pair<RegionShare<spacedim>, double>> regions;
  for (std::size_t i = 0; i < prm.regions.size(); ++i)
    regions.emplace_back(RegionShare<spacedim>(prm.regions[i], "regions." + std::to_string(i)), prm.regions[i].*factor);
  return [formula, regions](const Point<spacedim> &X) {
    double value = 1.;
    if constexpr (spacedim == 2)
      value = formula(X[0], X[1], 0.);
    else
      value = formula(X[0], X[1], X[2]);
    for (const auto &[share, inside] : regions)
      value *= 1. + (inside - 1.) * share(X);
    return value;
  };
}

} // namespace

template <>
split::Any<2> make_split<2>(const MaterialParameters &p)
{
  using material::NeoHooke, material::StVenantKirchhoff;
  const auto moduli = moduli_of(p);
  if (p.split == "none" && p.membrane == "neo_hooke")
    return split::None<NeoHooke>(NeoHooke(moduli));
  if (p.split == "none")
    return split::None<StVenantKirchhoff>(StVenantKirchhoff(moduli));
  if (p.split == "surface_stretch")
    return split::SurfaceStretch<NeoHooke>(NeoHooke(moduli));
  if (p.split == "volumetric_deviatoric_layer")
    return split::VolumetricDeviatoricLayer<2>(moduli);
  // In the plane the layer is the membrane.
  return split::SpectralLayer<2>(moduli);
}

template <>
split::Any<3> make_split<3>(const MaterialParameters &p)
{
  if (p.split == "spectral_layer")
    return split::SpectralLayer<3>(sheet_of(p),
                                   p.layer_points > 0 ? p.layer_points : split::SpectralLayer<3>::default_n_points);
  if (p.split == "volumetric_deviatoric_layer")
    return split::VolumetricDeviatoricLayer<3>(sheet_of(p));
  return p.bending == "canham" ? make_shell_split<material::Canham>(p) : make_shell_split<material::Koiter>(p);
}

template <int spacedim>
Toughness<spacedim> make_toughness(const Case &prm)
{
  return field_of<spacedim>(prm.fracture.toughness, prm, &RegionParameters::toughness);
}

template <int spacedim>
StiffnessField<spacedim> make_stiffness(const Case &prm)
{
  return field_of<spacedim>(prm.material.stiffness, prm, &RegionParameters::stiffness);
}

namespace
{

template <int degree, int spacedim>
Polyline<spacedim> make_line(const CrackParameters &line, const Surface<degree, spacedim> &surface,
                             const std::string &where)
{
  constexpr int                pieces = 64; // of each straight one
  std::vector<Point<spacedim>> corners;
  for (const auto &point : line.points)
    {
      if (point.size() != spacedim)
        throw InvalidParameter(where + ": a point has " + std::to_string(point.size()) + " coordinates, expected " +
                               std::to_string(spacedim));
      corners.emplace_back(Eigen::Map<const Point<spacedim>>(point.data()));
    }
  if (line.on_surface && corners.size() > 1)
    {
      std::vector<Point<spacedim>> dense;
      for (std::size_t k = 0; k + 1 < corners.size(); ++k)
        for (int j = k == 0 ? 0 : 1; j <= pieces; ++j)
          {
            const double          t = double(j) / pieces;
            const Point<spacedim> X = (1. - t) * corners[k] + t * corners[k + 1];
            dense.push_back(position(surface, closest_place(surface, X)));
          }
      corners = std::move(dense);
    }
  try
    {
      return Polyline<spacedim>(std::move(corners));
    }
  catch (const InvalidParameter &error)
    {
      throw InvalidParameter(where + ": " + error.what());
    }
}

} // namespace

template <int degree, int spacedim>
PreCrack<spacedim> make_cracks(const Case &prm, const Surface<degree, spacedim> &surface)
{
  std::vector<Polyline<spacedim>> cracks;
  for (std::size_t i = 0; i < prm.cracks.size(); ++i)
    cracks.push_back(make_line(prm.cracks[i], surface, "cracks." + std::to_string(i)));
  return PreCrack<spacedim>(std::move(cracks), prm.fracture.length_scale);
}

template <int degree, int spacedim>
std::vector<Polyline<spacedim>> make_fine_lines(const Case &prm, const Surface<degree, spacedim> &surface)
{
  std::vector<Polyline<spacedim>> lines;
  for (std::size_t i = 0; i < prm.fine_mesh.size(); ++i)
    lines.push_back(make_line(prm.fine_mesh[i].line, surface, "fine_mesh." + std::to_string(i)));
  return lines;
}

template Toughness<2>             make_toughness(const Case &);
template Toughness<3>             make_toughness(const Case &);
template StiffnessField<2>        make_stiffness(const Case &);
template StiffnessField<3>        make_stiffness(const Case &);
template PreCrack<2>              make_cracks(const Case &, const Surface<2, 2> &);
template PreCrack<2>              make_cracks(const Case &, const Surface<3, 2> &);
template PreCrack<2>              make_cracks(const Case &, const Surface<4, 2> &);
template PreCrack<3>              make_cracks(const Case &, const Surface<2, 3> &);
template PreCrack<3>              make_cracks(const Case &, const Surface<3, 3> &);
template PreCrack<3>              make_cracks(const Case &, const Surface<4, 3> &);
template std::vector<Polyline<2>> make_fine_lines(const Case &, const Surface<2, 2> &);
template std::vector<Polyline<2>> make_fine_lines(const Case &, const Surface<3, 2> &);
template std::vector<Polyline<2>> make_fine_lines(const Case &, const Surface<4, 2> &);
template std::vector<Polyline<3>> make_fine_lines(const Case &, const Surface<2, 3> &);
template std::vector<Polyline<3>> make_fine_lines(const Case &, const Surface<3, 3> &);
template std::vector<Polyline<3>> make_fine_lines(const Case &, const Surface<4, 3> &);

} // namespace sherd
