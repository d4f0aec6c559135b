#include <sherd/driver/case.h>

namespace sherd
{

void Case::declare(ParameterSection &section)
{
  section.subsection("surface", surface, "the body: a shape, its degree and dimension");
  section.subsection("material", material, "elastic constants, laws and energy split");
  section.subsection("fracture", fracture, "toughness, length scale and policies of the phase field");
  section.list("regions", regions, "parts of other toughness or stiffness; where they overlap factors multiply");
  section.list("cracks", cracks, "cracks that exist before the first step");
  section.list("supports", supports, "what is held or moved; where regions meet, the last one holds");
  section.list("loads", loads, "what pulls and presses");
  section.subsection("time", time, "time integration");
  section.choice(
      "solver", solver,
      {{"monolithic", SolverChoice::monolithic},
       {"staggered", SolverChoice::staggered},
       {"explicit", SolverChoice::explicit_},
       {"arc_length", SolverChoice::arc_length},
       {"modes", SolverChoice::modes}},
      "displacement and phase together, alternately, or explicit with integrator central_difference; without "
      "crack growth: equilibria along the arc of their path, or free vibrations");
  section.subsection("newton", newton, "nonlinear and linear solver");
  section.subsection("statics", statics, "equilibria of solver arc_length");
  section.subsection("arc_length", arc_length, "steps of solver arc_length; time is the load factor");
  section.subsection("modes", modes, "vibrations of solver modes; eigenvalues are omega^2");
  section.subsection("refinement", refinement, "where the mesh is refined");
  section.list("fine_mesh", fine_mesh,
               "lines along which the mesh is fine from the start, where a crack will run at once");
  section.subsection("stop", stop, "what ends the run before its end time");
  section.subsection("output", output, "what is written");
  section.subsection("checkpoint", checkpoint, "when a state to go on from is written");
}

void Case::resolve()
{
  surface.validate();
  surface.keep_chosen();
  material.resolve(surface.dimension);
  fracture.degradation.make();
  if ((time.integrator == "central_difference") != (solver == SolverChoice::explicit_))
    throw InvalidParameter("time.integrator = " + time.integrator + " with " +
                           (solver == SolverChoice::explicit_ ? "solver = explicit" : "an implicit solver") +
                           "; central_difference and solver = explicit belong together");
  const bool rests = solver == SolverChoice::arc_length || solver == SolverChoice::modes;
  if (solver == SolverChoice::arc_length && time.integrator != "quasi_static")
    throw InvalidParameter("time.integrator = " + time.integrator +
                           " with solver = arc_length, which follows equilibria; use quasi_static");
  if (time.integrator == "quasi_static" && time.steps.rule == StepRule::error)
    throw InvalidParameter("time.steps.rule = error with time.integrator = quasi_static, whose steps have no error in "
                           "time; use newton or fixed");
  if (rests && (!stop.crack_at.empty() || stop.crack_length || stop.elastic_share))
    throw InvalidParameter("stop: with solver = arc_length and modes no crack grows; a path ends at time.end or after "
                           "stop.steps");
  if (solver == SolverChoice::modes && surface.continuity.method == ContinuityParameters::Method::lagrange_multiplier)
    throw InvalidParameter("solver = modes with surface.continuity.method = lagrange_multiplier: multipliers have no "
                           "mass; use penalty");
  check_unused();
  if (solver == SolverChoice::explicit_)
    time.make_explicit();
  else
    time.make_integrator();
}

void Case::check_unused() const
{
  const auto unused = [](bool is_given, const std::string &what, const std::string &owner) {
    if (is_given)
      throw InvalidParameter(what + " is given, but belongs to " + owner + "; leave it out");
  };
  const FractureParameters fracture_defaults;
  const StopParameters     stop_defaults;
  unused(fracture.crack_density != "at1" && fracture.at1_width != fracture_defaults.at1_width, "fracture.at1_width",
         "crack_density = at1");
  unused(fracture.irreversibility != "penalty" && fracture.healing_penalty != fracture_defaults.healing_penalty,
         "fracture.healing_penalty", "irreversibility = penalty");
  unused(surface.continuity.method != ContinuityParameters::Method::penalty &&
             (surface.continuity.deformation != 0. || surface.continuity.phase != 0.),
         "surface.continuity.deformation or phase", "method = penalty");
  unused(stop.crack_at.empty() && stop.threshold != stop_defaults.threshold, "stop.threshold", "stop.crack_at");
  unused(solver == SolverChoice::modes && (stop.steps > 0 || !output.points.empty() || !output.reactions.empty()),
         "stop.steps, output.points or output.reactions", "solvers that take steps");
}

const std::vector<std::string> &model_sections()
{
  static const std::vector<std::string> sections{"surface",  "material", "fracture",   "regions",  "cracks",
                                                 "supports", "loads",    "refinement", "fine_mesh"};
  return sections;
}

} // namespace sherd
