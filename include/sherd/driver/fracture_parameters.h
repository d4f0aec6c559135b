#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/base/parameter_section.h>
#include <sherd/fracture/crack_density/any.h>
#include <sherd/fracture/degradation/any.h>
#include <sherd/fracture/irreversibility/any.h>

namespace sherd
{

/// Degradation function by name, theory C.2.
struct DegradationParameters
{
  std::string           function = "cubic";
  std::optional<double> slope;
  double                shape    = -.5;
  double                residual = 0.;

  void declare(ParameterSection &section);

  /// @throws InvalidParameter   from the function; a slope that is missing or given in vain
  degradation::Any make() const;
};

/// What breaks: toughness, length scale, policies by name.
struct FractureParameters
{
  Formula               toughness       = Formula("1", {"x", "y", "z"});
  double                length_scale    = NAN;
  std::string           crack_density   = "fourth_order";
  double                at1_width       = 1e-2;
  std::string           irreversibility = "history";
  double                healing_penalty = 300.;
  DegradationParameters degradation;

  void declare(ParameterSection &section);

  crack_density::Any   make_crack_density() const;
  irreversibility::Any make_irreversibility() const;
};

/// A crack that exists before the first step.
struct CrackParameters
{
  std::vector<std::vector<double>> points;
  bool                             on_surface = false;

  void declare(ParameterSection &section)
  {
    section.value("points", points, "length", range::any(), "corners of a polyline, each [x, y] or [x, y, z]");
    section.value("on_surface", on_surface,
                  "whether its pieces are divided and moved onto the surface, for curved ones");
  }
};

/// A line along which the mesh is fine from the start.
struct FineMeshParameters
{
  CrackParameters line;
  double          width = NAN;

  void declare(ParameterSection &section)
  {
    line.declare(section);
    section.value("width", width, "length", range::non_negative(), "how far from the line");
  }
};

/// A part of the surface of other toughness or stiffness.
struct RegionParameters
{
  std::string           kind = "box";
  std::vector<double>   lower, upper, centre;
  std::optional<double> radius;
  double                toughness = 1., stiffness = 1.;
  double                transition = 0.;

  void declare(ParameterSection &section);
};

} // namespace sherd
