#pragma once

#include <array>
#include <string>

#include <sherd/base/parameter_section.h>
#include <sherd/geometry/lower_degree.h>
#include <sherd/geometry/shapes/arc.h>
#include <sherd/geometry/shapes/box.h>
#include <sherd/geometry/shapes/cylinder.h>

/// Parameters of the shapes of geometry/shapes, one struct each; angles in degrees.
namespace sherd::shape_parameters
{

/// How a curved shape becomes a spline; `best` is exact where the shape and degree can be.
enum class FitChoice
{
  best,
  exact,
  rational,
  smooth
};

inline void declare_fit(ParameterSection &section, FitChoice &fit)
{
  section.choice("fit", fit,
                 {{"best", FitChoice::best},
                  {"exact", FitChoice::exact},
                  {"rational", FitChoice::rational},
                  {"smooth", FitChoice::smooth}},
                 "how it becomes a spline: exact and rational by NURBS, smooth by polynomials (arcs of any length)");
}

inline void declare_elements(ParameterSection &section, std::array<int, 2> &elements, const std::string &directions)
{
  section.value("elements", elements, range::at_least(1), "elements " + directions + ", before refinement");
}

inline void declare_length(ParameterSection &section, const std::string &name, double &length,
                           const std::string &meaning)
{
  section.value(name, length, "length", range::positive(), meaning);
}

inline void declare_angles(ParameterSection &section, const std::string &name, std::array<double, 2> &angles,
                           const std::string &meaning)
{
  section.value(name, angles, "degrees", range::any(), meaning);
}

struct Plate
{
  std::array<double, 2> size     = {1., 1.};
  std::array<int, 2>    elements = {10, 10};

  void declare(ParameterSection &section)
  {
    section.value("size", size, "length", range::positive(), "width and height");
    declare_elements(section, elements, "along width and height");
  }
};

struct NotchedPlate
{
  std::array<double, 2> size     = {1., 1.};
  std::array<double, 2> tip      = {.5, .5};
  std::array<int, 2>    elements = {10, 10};

  void declare(ParameterSection &section)
  {
    section.value("size", size, "length", range::positive(), "width and height");
    section.value("tip", tip, "length", range::positive(), "where the slit from the left edge ends; it runs along x");
    declare_elements(section, elements, "along width and height");
  }
};

struct AnnularPlate
{
  double                inner = 1., outer = 2.;
  std::array<double, 2> angles   = {0., 90.};
  std::array<int, 2>    elements = {10, 10};
  FitChoice             fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "inner", inner, "inner radius");
    declare_length(section, "outer", outer, "outer radius");
    declare_angles(section, "angles", angles, "begin and end");
    declare_elements(section, elements, "along the radius and around");
    declare_fit(section, fit);
  }
};

struct Polygon
{
  double radius   = 1.;
  int    sides    = 5;
  int    elements = 8;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "of the circle through the corners");
    section.value("sides", sides, range::at_least(3), "number of sides, and of patches");
    section.value("elements", elements, range::at_least(1), "along each side of a patch, before refinement");
  }
};

struct Cylinder
{
  double                radius = 1., length = 1.;
  std::array<double, 2> angles   = {-45., 45.};
  std::array<int, 2>    elements = {10, 10};
  FitChoice             fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    declare_length(section, "length", length, "length along the axis, x");
    declare_angles(section, "angles", angles, "begin and end about the axis, 0 on top (z)");
    declare_elements(section, elements, "along the axis and around");
    declare_fit(section, fit);
  }
};

struct Roof
{
  double             radius = 25., length = 50., half_angle = 40.;
  std::array<int, 2> elements = {8, 8};
  shapes::Part       part     = shapes::Part::whole;
  FitChoice          fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    declare_length(section, "length", length, "length along the axis, x");
    section.value("half_angle", half_angle, "degrees", range::open(0., 180.), "half of the opening");
    declare_elements(section, elements, "along the axis and around");
    section.choice("part", part, {{"whole", shapes::Part::whole}, {"quarter", shapes::Part::quarter}},
                   "all of it or what two planes of symmetry leave");
    declare_fit(section, fit);
  }
};

struct ClosedCylinder
{
  double             radius = 1., length = 1.;
  int                patches  = 4;
  std::array<int, 2> elements = {8, 8};
  FitChoice          fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    declare_length(section, "length", length, "length along the axis, x");
    section.value("patches", patches, range::at_least(1), "equal arcs, at least 3 unless the fit is smooth");
    declare_elements(section, elements, "of each patch, along the axis and around");
    declare_fit(section, fit);
  }
};

struct HemisphereWithHole
{
  double                radius = 1., hole_angle = 18.;
  std::array<double, 2> azimuth  = {0., 90.};
  std::array<int, 2>    elements = {8, 8};
  FitChoice             fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    section.value("hole_angle", hole_angle, "degrees", range::open(0., 90.), "of the rim of the hole, from the axis");
    declare_angles(section, "azimuth", azimuth, "begin and end");
    declare_elements(section, elements, "around and from the equator up");
    declare_fit(section, fit);
  }
};

struct Torus
{
  double                ring_radius = 2., tube_radius = 1.;
  std::array<double, 2> azimuth = {0., 90.}, tube_angles = {0., 90.};
  std::array<int, 2>    elements = {8, 8};
  FitChoice             fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "ring_radius", ring_radius, "of the centre line");
    declare_length(section, "tube_radius", tube_radius, "of the tube");
    declare_angles(section, "azimuth", azimuth, "begin and end about the axis");
    declare_angles(section, "tube_angles", tube_angles, "begin and end about the centre line, 0 on the outside");
    declare_elements(section, elements, "along the azimuth and around the tube");
    declare_fit(section, fit);
  }
};

struct ClosedTorus
{
  double             ring_radius = 2., tube_radius = 1.;
  std::array<int, 2> patches  = {4, 4};
  std::array<int, 2> elements = {4, 4};
  FitChoice          fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "ring_radius", ring_radius, "of the centre line");
    declare_length(section, "tube_radius", tube_radius, "of the tube");
    section.value("patches", patches, range::at_least(1), "along the azimuth and around the tube");
    declare_elements(section, elements, "of each patch, along the azimuth and around the tube");
    declare_fit(section, fit);
  }
};

struct Hyperboloid
{
  double                waist_radius = 1., shape = 1., height = 2.;
  std::array<double, 2> azimuth  = {0., 90.};
  std::array<int, 2>    elements = {8, 8};
  FitChoice             fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "waist_radius", waist_radius, "smallest radius");
    declare_length(section, "shape", shape, "c of (r / waist_radius)^2 - (z / c)^2 = 1");
    declare_length(section, "height", height, "height along the axis, half of it below the waist");
    declare_angles(section, "azimuth", azimuth, "begin and end");
    declare_elements(section, elements, "around and along the height");
    declare_fit(section, fit);
  }
};

/// Of six patches; hemisphere: the upper half of it.
struct Sphere
{
  double    radius   = 1.;
  int       elements = 8;
  FitChoice fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    section.value("elements", elements, range::at_least(1), "along each side of a patch, before refinement");
    declare_fit(section, fit);
  }
};

struct SpherePatch
{
  double             radius   = 1.;
  std::array<int, 2> elements = {8, 8};
  FitChoice          fit      = FitChoice::best;

  void declare(ParameterSection &section)
  {
    declare_length(section, "radius", radius, "radius");
    declare_elements(section, elements, "along x and y");
    declare_fit(section, fit);
  }
};

struct Box
{
  std::array<double, 3> size     = {1., 1., 1.};
  std::array<int, 3>    elements = {4, 4, 4};
  shapes::Lid           lid      = shapes::Lid::closed;

  void declare(ParameterSection &section)
  {
    section.value("size", size, "length", range::positive(), "along x, y and z");
    section.value("elements", elements, range::at_least(1), "elements along x, y and z, before refinement");
    section.choice("lid", lid, {{"closed", shapes::Lid::closed}, {"open", shapes::Lid::open}},
                   "whether it has a face on top");
  }
};

/// A file of G+Smo (.xml) or GoTools (.g2).
struct File
{
  std::string name;
  LowerDegree lower_degree = LowerDegree::refuse;

  void declare(ParameterSection &section)
  {
    section.value("name", name, "file, .xml of G+Smo or .g2 of GoTools, as seen from the working directory");
    section.choice("lower_degree", lower_degree, {{"refuse", LowerDegree::refuse}, {"elevate", LowerDegree::elevate}},
                   "what to do with patches of a lower degree than surface.degree");
  }
};

} // namespace sherd::shape_parameters

namespace sherd
{

/// The parameters of all shapes; one of them is used.
struct ShapeParameters
{
  shape_parameters::Plate              plate;
  shape_parameters::NotchedPlate       notched_plate;
  shape_parameters::AnnularPlate       annular_plate;
  shape_parameters::Polygon            polygon;
  shape_parameters::Cylinder           cylinder;
  shape_parameters::Roof               roof;
  shape_parameters::ClosedCylinder     closed_cylinder;
  shape_parameters::Sphere             sphere, hemisphere;
  shape_parameters::SpherePatch        sphere_patch;
  shape_parameters::HemisphereWithHole hemisphere_with_hole;
  shape_parameters::Torus              torus;
  shape_parameters::ClosedTorus        closed_torus;
  shape_parameters::Hyperboloid        hyperboloid;
  shape_parameters::Box                box;
  shape_parameters::File               file;

  /// Calls visit(name, parameters, dimensions, meaning) for every shape; dimensions are those of the spaces it can lie
  /// in: 2 for both the plane and space, 3 for space alone.
  template <class Visit>
  void for_each(const Visit &visit)
  {
    visit("plate", plate, 2, "flat rectangle; edges left, right, bottom, top");
    visit("notched_plate", notched_plate, 2,
          "flat rectangle with a slit from the left; edges of plate, lower_face, upper_face");
    visit("annular_plate", annular_plate, 2, "flat ring or part of one; edges inner, outer, begin, end");
    visit("polygon", polygon, 2, "flat regular polygon, one patch a corner; edge outer");
    visit("cylinder", cylinder, 3, "part of a cylinder about the x axis; edges left, right, bottom, top");
    visit("roof", roof, 3, "cylindrical roof, symmetric; edges left, right, bottom, top");
    visit("closed_cylinder", closed_cylinder, 3, "whole cylinder of several patches; edges left, right");
    visit("sphere", sphere, 3, "sphere of six patches; no edges");
    visit("hemisphere", hemisphere, 3, "upper half of a sphere, five patches; edge equator");
    visit("sphere_patch", sphere_patch, 3, "one of six equal parts of a sphere; edges left, right, bottom, top");
    visit("hemisphere_with_hole", hemisphere_with_hole, 3,
          "hemisphere with a hole at the pole, or part of it; edges left, right, equator, hole");
    visit("torus", torus, 3, "part of a torus about the z axis; edges left, right, bottom, top");
    visit("closed_torus", closed_torus, 3, "whole torus of several patches; no edges");
    visit("hyperboloid", hyperboloid, 3, "hyperboloid about the z axis, or part of it; edges left, right, bottom, top");
    visit("box", box, 3, "box of flat faces; edges rim (open), and folds such as \"bottom left\"");
    visit("file", file, 2, "geometry file of G+Smo (.xml) or GoTools (.g2); edges: its names, or boundary");
  }
};

} // namespace sherd
