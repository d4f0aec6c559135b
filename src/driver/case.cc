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
  section.choice("solver", solver,
                 {{"monolithic", SolverChoice::monolithic},
                  {"staggered", SolverChoice::staggered},
                  {"explicit", SolverChoice::explicit_}},
                 "displacement and phase together, alternately, or explicit with integrator central_difference");
  section.subsection("newton", newton, "nonlinear and linear solver");
  section.subsection("refinement", refinement, "where the mesh is refined");
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
  if (solver == SolverChoice::explicit_)
    time.check_unused();
  else
    time.make_integrator();
}

const std::vector<std::string> &model_sections()
{
  static const std::vector<std::string> sections{"surface", "material", "fracture", "regions",
                                                 "cracks",  "supports", "loads",    "refinement"};
  return sections;
}

} // namespace sherd
