#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>

/// What the terminal shows while a program runs.
namespace sherd
{

/// One accepted step.
struct ProgressReport
{
  int                   step;
  double                time, dt;
  int                   newton_iterations;
  long                  n_dofs;
  std::optional<double> crack_length; ///< not shown if the program has none
};

/// "2 h 05 min", "3 min 20 s", "4 s"; negative seconds count as none.
std::string print_duration(double seconds);

/// Writes one line a step: step, time, dt, Newton iterations, unknowns, crack length, share of the end time and an
/// estimate of what remains, from the pace of the last 50 steps:
/// @code
/// step   120  t 3.4500e-01  dt 1.00e-03  newton  4  dofs   122004  crack 0.4512   35 %  8 min 10 s left
/// @endcode
/// On a terminal every step has its line. In a log file lines follow each other after 0.1 s or more, so that a
/// million quick steps do not fill a disk; the first and the last step are always there.
class ProgressLine
{
public:
  using Clock = std::function<double()>; ///< wall seconds since any fixed instant

  /// Time goes from @p start_time (that of the checkpoint in a restarted run) to @p end_time > @p start_time. Make one
  /// on rank 0 only, or give other ranks a stream without buffer (`std::ostream(nullptr)`): nothing here communicates.
  ProgressLine(double start_time, double end_time, std::ostream &out);

  /// The same with a clock and the least seconds between two lines.
  ProgressLine(double start_time, double end_time, std::ostream &out, double seconds_between_lines, Clock clock);

  void report(const ProgressReport &report);

private:
  /// Wall seconds to the end at the recent pace; nothing before the pace is known.
  std::optional<double> remaining(double time) const;

  double                                start_time_, end_time_, seconds_between_lines_;
  std::ostream                         &out_;
  Clock                                 clock_;
  std::optional<double>                 last_line_; ///< when it was written
  std::deque<std::pair<double, double>> recent_;    ///< {wall, time} of the last steps
};

} // namespace sherd
