#pragma once

#include <memory>
#include <string>
#include <utility>

#include <sherd/solve/step_solver.h>

namespace sherd
{

/// Whether a crack tip crosses one element a step at most; without inertia time has no speed.
enum class StepBound
{
  by_waves,
  none
};

/// A solver of single steps that is chosen at run time: what Adaptivity and RecordedRun use of one. It is asked a few
/// times a step, and costs nothing that could be measured.
template <class Model>
class CaseSolver
{
public:
  static constexpr int degree   = Model::degree;
  static constexpr int spacedim = Model::spacedim;
  using StateType               = State<degree, spacedim>;
  using Result                  = StepResult<degree, spacedim>;

  template <StepSolver Solver>
  CaseSolver(std::unique_ptr<Solver> solver, StepBound bound)
      : solver_(std::make_unique<Chosen<Solver>>(std::move(solver))), bound_(bound)
  {
  }

  void   rebuild(const StateType &state) { solver_->rebuild(state); }
  void   keep_reactions() { solver_->keep_reactions(); }
  void   equilibrate_phase(StateType &state) { solver_->equilibrate_phase(state); }
  void   set_initial_acceleration(StateType &state) { solver_->set_initial_acceleration(state); }
  Result attempt(const StateType &state, double dt) { return solver_->attempt(state, dt); }

  const Model                        &model() const { return solver_->model(); }
  const Assembler<Model>             &assembler() const { return solver_->assembler(); }
  const ShellSpace<degree, spacedim> &space() const { return solver_->space(); }
  const Loads<spacedim>              &loads() const { return solver_->loads(); }
  Energies                            energies(const StateType &state) { return solver_->energies(state); }
  Point<spacedim>                     reaction(const std::string &edge) const { return solver_->reaction(edge); }
  PhaseTimers                        &timers() { return solver_->timers(); }

  /// c_R where steps are bounded by it, 0 otherwise.
  double rayleigh_speed() const { return bound_ == StepBound::by_waves ? solver_->rayleigh_speed() : 0.; }

  double largest_step() const { return solver_->largest_step(); }

private:
  struct Interface
  {
    virtual ~Interface()                                                              = default;
    virtual void                                rebuild(const StateType &)            = 0;
    virtual void                                keep_reactions()                      = 0;
    virtual void                                equilibrate_phase(StateType &)        = 0;
    virtual void                                set_initial_acceleration(StateType &) = 0;
    virtual Result                              attempt(const StateType &, double)    = 0;
    virtual const Model                        &model() const                         = 0;
    virtual const Assembler<Model>             &assembler() const                     = 0;
    virtual const ShellSpace<degree, spacedim> &space() const                         = 0;
    virtual Energies                            energies(const StateType &)           = 0;
    virtual Point<spacedim>                     reaction(const std::string &) const   = 0;
    virtual const Loads<spacedim>              &loads() const                         = 0;
    virtual double                              rayleigh_speed() const                = 0;
    virtual double                              largest_step() const                  = 0;
    virtual PhaseTimers                        &timers()                              = 0;
  };

  template <class Solver>
  struct Chosen final : Interface
  {
    explicit Chosen(std::unique_ptr<Solver> solver) : s(std::move(solver)) {}

    void                    rebuild(const StateType &state) override { s->rebuild(state); }
    void                    keep_reactions() override { s->keep_reactions(); }
    void                    equilibrate_phase(StateType &state) override { s->equilibrate_phase(state); }
    void                    set_initial_acceleration(StateType &state) override { s->set_initial_acceleration(state); }
    Result                  attempt(const StateType &state, double dt) override { return s->attempt(state, dt); }
    const Model            &model() const override { return s->model(); }
    const Assembler<Model> &assembler() const override { return s->assembler(); }
    const ShellSpace<degree, spacedim> &space() const override { return s->space(); }
    Energies                            energies(const StateType &state) override { return s->energies(state); }
    Point<spacedim>                     reaction(const std::string &edge) const override { return s->reaction(edge); }
    const Loads<spacedim>              &loads() const override { return s->loads(); }
    double                              rayleigh_speed() const override { return s->rayleigh_speed(); }
    double                              largest_step() const override { return s->largest_step(); }
    PhaseTimers                        &timers() override { return s->timers(); }

    std::unique_ptr<Solver> s;
  };

  std::unique_ptr<Interface> solver_;
  StepBound                  bound_;
};

} // namespace sherd
