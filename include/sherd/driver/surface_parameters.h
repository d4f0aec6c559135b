#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <sherd/driver/shape_parameters.h>
#include <sherd/space/continuity.h>

namespace sherd
{

/// What keeps a surface of several patches smooth, in a case file.
struct ContinuityParameters
{
  enum class Method
  {
    none,
    penalty,
    lagrange_multiplier
  };

  Method method      = Method::penalty;
  double deformation = 0.;
  double phase       = 0.;

  void declare(ParameterSection &section)
  {
    section.choice(
        "method", method,
        {{"none", Method::none}, {"penalty", Method::penalty}, {"lagrange_multiplier", Method::lagrange_multiplier}},
        "what keeps angle and phase smooth across interfaces of patches; none: hinges");
    section.value("deformation", deformation, "-", range::non_negative(),
                  "factor of the penalty of the angle; 0: the default of the degree");
    section.value("phase", phase, "-", range::non_negative(), "factor of the penalty of the phase; 0: the default");
  }

  Continuity make() const;
};

/// The reference surface of a case: a shape with its own section, degree and dimension, and how it is cut.
struct SurfaceParameters
{
  std::string          shape     = "plate";
  int                  dimension = 2;
  int                  degree    = 2;
  ShapeParameters      shapes;
  std::array<int, 2>   cut          = {1, 1};
  bool                 cut_c0_lines = false;
  ContinuityParameters continuity;

  void declare(ParameterSection &section);

  /// From now on only the section of the chosen shape is declared, so that used.yaml holds no others.
  void keep_chosen() { all_shapes_ = false; }

  /// @throws InvalidParameter   a section of another shape than the chosen one is given; a shape of space in the plane
  void validate() const;

private:
  bool all_shapes_ = true;
};

} // namespace sherd
