#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <sherd/base/exceptions.h>
#include <sherd/base/parameter_section.h>
#include <sherd/base/print.h>

namespace sherd
{

/// Factors of the step size, paper Eq. (13), and what happens on rejection (theory F.3, F.4).
struct StepControlSettings
{
  double initial        = 0.;   ///< first step [time], > 0
  double few            = 1.5;  ///< fewer than 4 Newton iterations
  double normal         = 1.1;  ///< 4 iterations
  double many           = .5;   ///< more than 4
  double refined        = .2;   ///< after local refinement
  double rejected       = .5;   ///< first retry
  double rejected_again = .2;   ///< later retries
  double courant        = .99;  ///< dt_max = courant * dx_min / (0.6 c_R)
  double smallest       = 1e-8; ///< dt_min / dt_max, below which a run ends

  void declare(ParameterSection &section)
  {
    section.value("initial", initial, "time", range::positive(), "first step");
    section.value("few", few, "-", range::positive(), "factor after fewer than 4 Newton iterations");
    section.value("normal", normal, "-", range::positive(), "factor after 4 iterations");
    section.value("many", many, "-", range::left_open(0., 1.), "factor after more than 4 iterations");
    section.value("refined", refined, "-", range::left_open(0., 1.), "factor after local refinement");
    section.value("rejected", rejected, "-", range::open(0., 1.), "factor of the first retry of a rejected step");
    section.value("rejected_again", rejected_again, "-", range::open(0., 1.), "factor of later retries");
    section.value("courant", courant, "-", range::left_open(0., 1.), "largest step over dx_min / (0.6 c_R)");
    section.value("smallest", smallest, "-", range::open(0., 1.), "smallest step over the largest; the run ends below");
  }
};

/// Step sizes from the number of Newton iterations, paper Eq. (13), bounded by dt_max = dx_min / (0.6 c_R): a crack tip
/// stays below 0.6 c_R and so crosses at most one element a step.
class StepController
{
public:
  /// What it remembers of accepted steps, for checkpoints.
  struct State
  {
    double step;    ///< next step [time]
    double largest; ///< its bound [time]
  };

  /// @throws InvalidParameter   a step or factor that is not positive; a rejected step that would not become smaller
  explicit StepController(const StepControlSettings &settings) : settings_(settings), dt_(settings.initial)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    require("initial", settings.initial, infinity);
    require("few", settings.few, infinity);
    require("normal", settings.normal, infinity);
    require("many", settings.many, infinity);
    require("refined", settings.refined, infinity);
    require("rejected", settings.rejected, 1.);
    require("rejected_again", settings.rejected_again, 1.);
    require("courant", settings.courant, infinity);
    require("smallest", settings.smallest, 1.);
  }

  /// The bound follows the mesh. @param shortest_edge dx_min [length]  @param rayleigh_speed c_R [length/time]
  void bound(double shortest_edge, double rayleigh_speed)
  {
    largest_ = settings_.courant * shortest_edge / (.6 * rayleigh_speed);
    dt_      = std::min(dt_, largest_);
  }

  State state() const { return {dt_, largest_}; }

  /// Goes on from a checkpoint; the settings stay its own.
  void restore(const State &state)
  {
    dt_      = state.step;
    largest_ = state.largest;
    retries_ = 0;
  }

  double step() const { return dt_; }
  double largest() const { return largest_; }

  /// Step to take so that @p remaining is not overshot: the last step is @p remaining itself, and none is left that is
  /// tiny.
  double step_within(double remaining) const
  {
    if (dt_ >= remaining * (1. - 1e-10))
      return remaining;
    return dt_ > .5 * remaining ? .5 * remaining : dt_;
  }

  /// After an accepted step of @p newton iterations.
  void accept(int newton)
  {
    retries_ = 0;
    scale(newton < 4 ? settings_.few : newton == 4 ? settings_.normal : settings_.many);
  }

  /// Instead of accept() when the mesh was refined after the step; also before the step is repeated on a finer mesh.
  void refine()
  {
    retries_ = 0;
    scale(settings_.refined);
  }

  /// After a rejected step of size @p attempted, the present one if left out.
  /// @throws NoConvergence   when the step falls below dt_min; @p why is part of the message. The step is then the one
  ///                         before the rejections, where a checkpoint can go on with other settings
  void reject(const std::string &why, double attempted = std::numeric_limits<double>::infinity())
  {
    if (retries_ == 0)
      before_rejections_ = dt_;
    dt_ = std::min(dt_, attempted);
    scale(retries_++ == 0 ? settings_.rejected : settings_.rejected_again);
    const double reference = std::isfinite(largest_) ? largest_ : settings_.initial;
    if (dt_ < settings_.smallest * reference)
      {
        const NoConvergence error("the step size fell to " + print(dt_) + ", " + print(dt_ / reference) +
                                  " of its bound, after " + std::to_string(retries_) + " rejections: " + why +
                                  "; try a finer mesh at the crack, a smaller load step or degradation::Quadratic");
        dt_      = before_rejections_;
        retries_ = 0;
        throw error;
      }
  }

private:
  static void require(const std::string &name, double value, double below)
  {
    if (!(value > 0. && value < below))
      throw InvalidParameter("step control: " + name + " = " + print(value) + ", expected a finite value > 0" +
                             (std::isfinite(below) ? " and < " + print(below) : ""));
  }

  void scale(double factor) { dt_ = std::min(dt_ * factor, largest_); }

  StepControlSettings settings_;
  double              dt_;
  double              largest_           = std::numeric_limits<double>::infinity(); ///< until bound() is called
  int                 retries_           = 0;
  double              before_rejections_ = 0.;
};

} // namespace sherd
