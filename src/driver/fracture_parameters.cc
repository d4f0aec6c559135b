#include <sherd/driver/fracture_parameters.h>

#include "given.h"

namespace sherd
{

void DegradationParameters::declare(ParameterSection &section)
{
  section.choice("function", function, {"cubic", "quadratic", "quartic", "rational"}, "degradation function g");
  section.value("slope", slope, "-", range::positive(),
                "g'(1): s of cubic and quartic (none: 1e-4), m of rational, which needs it");
  section.value("shape", shape, "-", range::at_least(-.9), "P of rational, the softening");
  section.value("residual", residual, "-", range::right_open(0., 1.),
                "share of the active stiffness that a broken surface keeps; 1e-8 where quasi-static parts come off");
}

degradation::Any DegradationParameters::make() const
{
  const std::string where = "fracture.degradation: function = " + function;
  const auto        check = [&](const std::initializer_list<std::string> &needed,
                         const std::initializer_list<std::string> &allowed = {}) {
    internal::check_given(where, {{"slope", slope.has_value()}, {"shape", shape != -.5}}, needed, allowed);
  };
  if (function == "quadratic")
    {
      check({});
      return {degradation::Quadratic(), residual};
    }
  if (function == "rational")
    {
      check({"slope"}, {"shape"});
      return {degradation::Rational(*slope, shape), residual};
    }
  check({}, {"slope"});
  if (function == "quartic")
    return {degradation::Quartic(slope.value_or(1e-4)), residual};
  return {degradation::Cubic(slope.value_or(1e-4)), residual};
}

void FractureParameters::declare(ParameterSection &section)
{
  section.value("toughness", toughness, "energy/length", "fracture toughness Gc by position");
  section.value("length_scale", length_scale, "length", range::positive(), "length scale l0 of the phase field");
  section.choice("crack_density", crack_density, {"fourth_order", "second_order", "at1"},
                 "energy density of a smeared crack");
  section.value("at1_width", at1_width, "-", range::left_open(0., .1), "damage up to which the bound of at1 is soft");
  section.choice("irreversibility", irreversibility, {"history", "penalty", "none"}, "what keeps cracks from healing");
  section.value("healing_penalty", healing_penalty, "-", range::positive(),
                "factor of the penalty on healing, times Gc / l0");
  section.subsection("degradation", degradation, "what damage leaves of the stiffness");
}

crack_density::Any FractureParameters::make_crack_density() const
{
  if (crack_density == "at1")
    return crack_density::Any(crack_density::AT1(at1_width));
  if (crack_density == "second_order")
    return crack_density::Any(crack_density::SecondOrder{});
  return {};
}

irreversibility::Any FractureParameters::make_irreversibility() const
{
  if (irreversibility == "penalty")
    return irreversibility::Any(irreversibility::Penalty(healing_penalty));
  if (irreversibility == "none")
    return irreversibility::Any(irreversibility::None{});
  return {};
}

void RegionParameters::declare(ParameterSection &section)
{
  section.choice("kind", kind, {"box", "ball"}, "a box between lower and upper corner, or a ball");
  section.value("lower", lower, "length", range::any(), "lower corner of a box");
  section.value("upper", upper, "length", range::any(), "upper corner of a box");
  section.value("centre", centre, "length", range::any(), "centre of a ball");
  section.value("radius", radius, "length", range::positive(), "radius of a ball");
  section.value("toughness", toughness, "-", range::positive(), "factor of the toughness inside");
  section.value("stiffness", stiffness, "-", range::positive(), "factor of the moduli inside");
  section.value("transition", transition, "length", range::non_negative(),
                "width of the cosine ramp around the outline, half of it outside; 0: a jump");
}

} // namespace sherd
