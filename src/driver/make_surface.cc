#include <sherd/driver/make_surface.h>

#include <filesystem>

#include <sherd/geometry/gismo_xml.h>
#include <sherd/geometry/gotools.h>
#include <sherd/geometry/shapes.h>
#include <sherd/geometry/split.h>

namespace sherd
{
namespace
{

using shape_parameters::FitChoice;

std::array<double, 2> radians(const std::array<double, 2> &degrees)
{
  return {degrees[0] * M_PI / 180., degrees[1] * M_PI / 180.};
}

/// Exact arcs are shorter than half a turn. @param openings   of the arcs in degrees
shapes::Fit fit_of_arcs(FitChoice choice, std::initializer_list<double> openings)
{
  switch (choice)
    {
    case FitChoice::exact:
      return shapes::Fit::exact;
    case FitChoice::rational:
      return shapes::Fit::rational;
    case FitChoice::smooth:
      return shapes::Fit::smooth;
    case FitChoice::best:
      break;
    }
  for (const double opening : openings)
    if (!(opening < 180.))
      return shapes::Fit::smooth;
  return shapes::Fit::exact;
}

template <int degree>
shapes::Fit fit_of_sphere(FitChoice choice)
{
  return choice == FitChoice::best ? shapes::best_sphere_fit<degree> : fit_of_arcs(choice, {});
}

template <int degree, int spacedim>
Surface<degree, spacedim> read_file(const Environment &env, const shape_parameters::File &file)
{
  const auto extension = std::filesystem::path(file.name).extension();
  if (extension == ".xml")
    return read_gismo_xml<degree, spacedim>(env, file.name, file.lower_degree);
  if (extension == ".g2")
    return read_g2<degree, spacedim>(env, file.name, file.lower_degree);
  throw InvalidParameter("surface.file.name = \"" + file.name +
                         "\", expected a name that ends in .xml (G+Smo) or .g2 " + "(GoTools)");
}

/// Shapes of the plane and of space.
template <int degree, int spacedim>
Surface<degree, spacedim> make_flat(const Environment &env, const SurfaceParameters &p)
{
  const auto &all = p.shapes;
  if (p.shape == "plate")
    return shapes::plate<degree, spacedim>(all.plate.size, all.plate.elements);
  if (p.shape == "notched_plate")
    return shapes::notched_plate<degree, spacedim>(all.notched_plate.size, all.notched_plate.tip,
                                                   all.notched_plate.elements);
  if (p.shape == "annular_plate")
    {
      const auto &s = all.annular_plate;
      return shapes::annular_plate<degree, spacedim>(s.inner, s.outer, radians(s.angles), s.elements,
                                                     fit_of_arcs(s.fit, {s.angles[1] - s.angles[0]}));
    }
  if (p.shape == "polygon")
    return shapes::polygon<degree, spacedim>(all.polygon.radius, all.polygon.sides, all.polygon.elements);
  if (p.shape == "file")
    return read_file<degree, spacedim>(env, all.file);
  throw InvalidParameter("surface.shape = " + p.shape + " in the plane, but it lies in space; set " +
                         "surface.dimension = 3");
}

/// Shapes of revolution.
template <int degree>
Surface<degree, 3> make_revolution(const Environment &env, const SurfaceParameters &p)
{
  const auto &all = p.shapes;
  if (p.shape == "hemisphere_with_hole")
    {
      const auto &s = all.hemisphere_with_hole;
      return shapes::hemisphere_with_hole<degree>(s.radius, s.hole_angle * M_PI / 180., radians(s.azimuth), s.elements,
                                                  fit_of_arcs(s.fit, {s.azimuth[1] - s.azimuth[0]}));
    }
  if (p.shape == "torus")
    {
      const auto &s = all.torus;
      return shapes::torus<degree>(
          s.ring_radius, s.tube_radius, radians(s.azimuth), radians(s.tube_angles), s.elements,
          fit_of_arcs(s.fit, {s.azimuth[1] - s.azimuth[0], s.tube_angles[1] - s.tube_angles[0]}));
    }
  if (p.shape == "closed_torus")
    {
      const auto &s = all.closed_torus;
      return shapes::closed_torus<degree>(s.ring_radius, s.tube_radius, s.patches, s.elements,
                                          fit_of_arcs(s.fit, {360. / s.patches[0], 360. / s.patches[1]}));
    }
  if (p.shape == "hyperboloid")
    {
      const auto &s = all.hyperboloid;
      return shapes::hyperboloid<degree>(s.waist_radius, s.shape, s.height, radians(s.azimuth), s.elements,
                                         fit_of_arcs(s.fit, {s.azimuth[1] - s.azimuth[0]}));
    }
  return make_flat<degree, 3>(env, p);
}

/// Shapes of space.
template <int degree>
Surface<degree, 3> make_curved(const Environment &env, const SurfaceParameters &p)
{
  const auto &all = p.shapes;
  if (p.shape == "cylinder")
    {
      const auto &s = all.cylinder;
      return shapes::cylinder<degree>(s.radius, s.length, radians(s.angles), s.elements,
                                      fit_of_arcs(s.fit, {s.angles[1] - s.angles[0]}));
    }
  if (p.shape == "roof")
    {
      const auto &s = all.roof;
      return shapes::roof<degree>(s.radius, s.length, s.half_angle * M_PI / 180., s.elements,
                                  fit_of_arcs(s.fit, {2. * s.half_angle}), s.part);
    }
  if (p.shape == "closed_cylinder")
    {
      const auto &s = all.closed_cylinder;
      return shapes::closed_cylinder<degree>(s.radius, s.length, s.patches, s.elements,
                                             fit_of_arcs(s.fit, {360. / s.patches}));
    }
  if (p.shape == "sphere")
    return shapes::sphere<degree>(all.sphere.radius, all.sphere.elements, fit_of_sphere<degree>(all.sphere.fit));
  if (p.shape == "hemisphere")
    return shapes::hemisphere<degree>(all.hemisphere.radius, all.hemisphere.elements,
                                      fit_of_sphere<degree>(all.hemisphere.fit));
  if (p.shape == "sphere_patch")
    return shapes::sphere_patch<degree>(all.sphere_patch.radius, all.sphere_patch.elements,
                                        fit_of_sphere<degree>(all.sphere_patch.fit));
  if (p.shape == "box")
    return shapes::box<degree>(all.box.size, all.box.elements, all.box.lid);
  return make_revolution<degree>(env, p);
}

} // namespace

template <int degree, int spacedim>
Surface<degree, spacedim> make_surface(const Environment &env, const SurfaceParameters &parameters)
{
  auto surface = [&] {
    if constexpr (spacedim == 3)
      return make_curved<degree>(env, parameters);
    else
      return make_flat<degree, 2>(env, parameters);
  }();
  if (parameters.cut_c0_lines)
    surface = split_at_c0_lines(surface);
  if (parameters.cut != std::array<int, 2>{1, 1})
    surface = split_patches(surface, parameters.cut);
  return surface;
}

template Surface<2, 2> make_surface(const Environment &, const SurfaceParameters &);
template Surface<3, 2> make_surface(const Environment &, const SurfaceParameters &);
template Surface<4, 2> make_surface(const Environment &, const SurfaceParameters &);
template Surface<2, 3> make_surface(const Environment &, const SurfaceParameters &);
template Surface<3, 3> make_surface(const Environment &, const SurfaceParameters &);
template Surface<4, 3> make_surface(const Environment &, const SurfaceParameters &);

} // namespace sherd
