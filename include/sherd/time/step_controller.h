#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <sherd/base/exceptions.h>
#include <sherd/base/parameter_section.h>
#include <sherd/base/print.h>

namespace sherd
{

/// What decides the size of the next step.
enum class StepRule
{
  newton, ///< the number of Newton iterations, paper Eq. (13)
  fixed,  ///< nothing: the first step is the size of all
  error   ///< the error of a step that the integrator estimates
};

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

  StepRule            rule       = StepRule::newton;
  double              tolerance  = 1e-6;  ///< of the estimated error of a step over the size of the body; rule error
  std::vector<double> times      = {};    ///< steps end exactly here, and a frame is written [time]
  bool                hit_frames = false; ///< whether steps end exactly at the evenly spaced frames

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
    section.choice("rule", rule, {{"newton", StepRule::newton}, {"fixed", StepRule::fixed}, {"error", StepRule::error}},
                   "what sets the step: Newton iterations (paper Eq. (13)), nothing, or the estimated error");
    section.value("tolerance", tolerance, "-", range::positive(),
                  "error of a step over the size of the body that is allowed, for rule error");
    section.value("times", times, "time", range::positive(),
                  "steps end exactly at these times, and frames are written");
    section.value("hit_frames", hit_frames, "whether steps end exactly at the evenly spaced frames");
  }
};

/// Step sizes, bounded by dt_max = dx_min / (0.6 c_R): a crack tip stays below 0.6 c_R and so crosses at most one
/// element a step. They follow the number of Newton iterations (paper Eq. (13)), stay fixed, or keep the estimated
/// error e of a step near its tolerance with the proportional and integral factor
///
///   (0.8 tolerance / e)^(0.7/3) (e_before / 0.8 tolerance)^(0.4/3), between rejected_again and few;
///
/// a step with e > tolerance is repeated with (0.8 tolerance / e)^(1/3). Whatever the rule, a step that was shortened
/// to end at a given time does not let the next ones grow: it says nothing of longer ones, nor does its error of a
/// trend.
///
/// Source: theory F.3.
class StepController
{
public:
  /// What it remembers of accepted steps, for checkpoints.
  struct State
  {
    double step;                ///< next step [time]
    double largest;             ///< its bound [time]
    double previous_error = 0.; ///< estimate of the last step, rule error; 0: none
  };

  /// @throws InvalidParameter   a step or factor that is not positive; a rejected step that would not become smaller
  explicit StepController(const StepControlSettings &settings) : settings_(settings), dt_(settings.initial)
  {
    require("initial", settings.initial, infinity);
    require("few", settings.few, infinity);
    require("normal", settings.normal, infinity);
    require("many", settings.many, infinity);
    require("refined", settings.refined, infinity);
    require("rejected", settings.rejected, 1.);
    require("rejected_again", settings.rejected_again, 1.);
    require("courant", settings.courant, infinity);
    require("smallest", settings.smallest, 1.);
    require("tolerance", settings.tolerance, infinity);
    stop_at(settings.times);
  }

  const StepControlSettings &settings() const { return settings_; }

  /// The bound follows the mesh. @param shortest_edge dx_min [length]  @param rayleigh_speed c_R [length/time]
  void bound(double shortest_edge, double rayleigh_speed)
  {
    largest_ = std::min(cap_, settings_.courant * shortest_edge / (.6 * rayleigh_speed));
    dt_      = std::min(dt_, largest_);
  }

  /// No step is longer than @p largest [time] from now on, whatever the mesh.
  void cap(double largest)
  {
    cap_     = largest;
    largest_ = std::min(largest_, cap_);
    dt_      = std::min(dt_, largest_);
  }

  /// Steps stay below the largest stable one of an explicit scheme, without forgetting their size. Infinite: no limit.
  void limit(double largest_stable) { stable_ = largest_stable; }

  /// Steps end exactly at these times besides. A time that differs from one that is known by rounding is left out.
  /// @throws InvalidParameter   a time that is not finite
  void stop_at(const std::vector<double> &times)
  {
    for (const double time : times)
      {
        if (!std::isfinite(time))
          throw InvalidParameter("step control: times has " + print(time) + ", expected finite times");
        const auto place = std::lower_bound(stops_.begin(), stops_.end(), time);
        const bool known = (place != stops_.end() && same_time(*place, time)) ||
                           (place != stops_.begin() && same_time(*std::prev(place), time));
        if (!known)
          stops_.insert(place, time);
      }
  }

  /// Where the steps after @p time have to end next: the next of the given times, or @p end.
  double next_stop(double time, double end) const
  {
    const auto next = std::upper_bound(stops_.begin(), stops_.end(), time);
    return next == stops_.end() || *next > end || same_time(*next, end) ? end : *next;
  }

  State state() const { return {dt_, largest_, previous_error_}; }

  /// Goes on from a checkpoint; the settings stay its own.
  void restore(const State &state)
  {
    dt_             = state.step;
    largest_        = state.largest;
    previous_error_ = state.previous_error;
    retries_        = 0;
  }

  double step() const { return std::min(dt_, stable_); }
  double largest() const { return largest_; }

  /// Step to take so that @p remaining is not overshot: the last step is @p remaining itself, and none is left that is
  /// tiny.
  double step_within(double remaining) const
  {
    if (step() >= remaining * (1. - 1e-10))
      return remaining;
    return step() > .5 * remaining ? .5 * remaining : step();
  }

  /// After an accepted step of @p newton iterations. @param error  estimated, for rule error
  /// @param taken   its size, the present one if left out
  void accept(int newton, double error = 0., double taken = infinity)
  {
    retries_             = 0;
    taken                = std::min(taken, step());
    const bool shortened = taken < step() * (1. - 1e-10);
    switch (settings_.rule)
      {
      case StepRule::newton:
        {
          const double factor = newton < 4 ? settings_.few : newton == 4 ? settings_.normal : settings_.many;
          if (!shortened)
            scale(factor);
          else if (factor < 1.)
            dt_ = std::min(dt_, factor * taken);
          break;
        }
      case StepRule::fixed:
        dt_ = std::min(settings_.initial, largest_);
        break;
      case StepRule::error:
        {
          const double wished = taken * error_factor(error);
          if (!shortened || wished < taken)
            dt_ = std::min(wished, largest_);
          previous_error_ = shortened ? 0. : error; // that of a shorter step tells no trend
          break;
        }
      }
  }

  /// Instead of accept() when the mesh was refined after the step; also before the step is repeated on a finer mesh.
  void refine()
  {
    retries_        = 0;
    previous_error_ = 0.;
    if (settings_.rule != StepRule::fixed)
      scale(settings_.refined);
  }

  /// Whether the estimated error of a step forbids to accept it.
  bool is_inaccurate(double error) const
  {
    return settings_.rule == StepRule::error && !(error <= settings_.tolerance);
  }

  /// After a rejected step of size @p attempted, the present one if left out.
  /// @throws NoConvergence   when the step falls below dt_min; @p why is part of the message. The step is then the one
  ///                         before the rejections, where a checkpoint can go on with other settings
  void reject(const std::string &why, double attempted = infinity)
  {
    shorten(attempted, retries_ == 0 ? settings_.rejected : settings_.rejected_again, why,
            "try a finer mesh at the crack, a smaller load step or degradation::Quadratic");
  }

  /// After a step of size @p attempted with is_inaccurate(error).
  /// @throws NoConvergence   as reject()
  void reject_inaccurate(double error, double attempted)
  {
    const double factor =
        std::isfinite(error) ? std::max(std::cbrt(aim() / error), settings_.rejected_again) : settings_.rejected_again;
    shorten(attempted, factor,
            "the estimated error " + print(error) + " exceeds the tolerance " + print(settings_.tolerance),
            "try a larger tolerance or rule newton");
  }

private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  static bool same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

  static void require(const std::string &name, double value, double below)
  {
    if (!(value > 0. && value < below))
      throw InvalidParameter("step control: " + name + " = " + print(value) + ", expected a finite value > 0" +
                             (std::isfinite(below) ? " and < " + print(below) : ""));
  }

  /// Error that steps aim at.
  double aim() const { return .8 * settings_.tolerance; }

  /// Factor of the step after one with this error.
  double error_factor(double error) const
  {
    if (!(error > 0.))
      return settings_.few;
    const double factor = previous_error_ > 0.
                              ? std::pow(aim() / error, .7 / 3.) * std::pow(previous_error_ / aim(), .4 / 3.)
                              : std::cbrt(aim() / error);
    return std::clamp(factor, settings_.rejected_again, std::max(settings_.few, 1.));
  }

  void shorten(double attempted, double factor, const std::string &why, const std::string &advice)
  {
    if (retries_ == 0)
      before_rejections_ = dt_;
    ++retries_;
    dt_ = std::min(step(), attempted);
    scale(factor);
    const double reference = std::isfinite(largest_) ? largest_ : settings_.initial;
    if (dt_ < settings_.smallest * reference)
      {
        const NoConvergence error("the step size fell to " + print(dt_) + ", " + print(dt_ / reference) +
                                  " of its bound, after " + std::to_string(retries_) + " rejections: " + why + "; " +
                                  advice);
        dt_      = before_rejections_;
        retries_ = 0;
        throw error;
      }
  }

  void scale(double factor) { dt_ = std::min(dt_ * factor, largest_); }

  StepControlSettings settings_;
  double              dt_;
  double              largest_ = infinity; ///< until bound() is called
  double              cap_     = infinity; ///< no step is longer, whatever the mesh
  double              stable_  = infinity; ///< of an explicit scheme
  std::vector<double> stops_;              ///< ascending
  int                 retries_           = 0;
  double              before_rejections_ = 0.;
  double              previous_error_    = 0.;
};

} // namespace sherd
