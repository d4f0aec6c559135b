#include <sherd/driver/surface_parameters.h>

#include <sherd/base/parameters.h>

namespace sherd
{

Continuity ContinuityParameters::make() const
{
  switch (method)
    {
    case Method::penalty:
      return continuity::Penalty{deformation, phase};
    case Method::lagrange_multiplier:
      return continuity::LagrangeMultiplier{};
    case Method::none:
      break;
    }
  return continuity::None{};
}

void SurfaceParameters::declare(ParameterSection &section)
{
  std::vector<std::string> names;
  shapes.for_each([&](const std::string &name, auto &, int, const std::string &) { names.push_back(name); });
  section.choice("shape", shape, names, "what it is; the section of this name has its parameters");
  section.choice("dimension", dimension, {{"2", 2}, {"3", 3}}, "2: in the plane, a membrane; 3: in space, a shell");
  section.choice("degree", degree, {{"2", 2}, {"3", 3}, {"4", 4}}, "degree of the splines");
  section.value("cut", cut, range::at_least(1), "parts along u and v into which every patch is cut");
  section.value("cut_c0_lines", cut_c0_lines, "whether patches are cut where they have a kink, for geometry files");
  section.subsection("continuity", continuity, "what keeps surface and phase smooth across interfaces of patches");
  shapes.for_each([&](const std::string &name, auto &parameters, int dimensions, const std::string &meaning) {
    if (all_shapes_ || name == shape)
      section.subsection(name, parameters, meaning + (dimensions == 3 ? " (in space)" : ""));
  });
}

void SurfaceParameters::validate() const
{
  auto all = shapes;
  all.for_each([&](const std::string &name, auto &parameters, int dimensions, const std::string &) {
    if (name == shape)
      {
        if (dimensions > dimension)
          throw InvalidParameter("surface.shape = " + shape + " in the plane, but it lies in space; set " +
                                 "surface.dimension = 3");
        return;
      }
    std::decay_t<decltype(parameters)> unused;
    if (used_yaml(ParameterSection::of(parameters), {}) != used_yaml(ParameterSection::of(unused), {}))
      throw InvalidParameter("surface." + name + " is given, but surface.shape = " + shape +
                             "; remove the section, or set surface.shape = " + name);
  });
}

} // namespace sherd
