#include <sherd/base/progress.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace sherd
{
namespace
{

constexpr std::size_t n_recent = 50;

double steady_seconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double pause_between_lines(const std::ostream &out)
{
  return &out == &std::cout && isatty(STDOUT_FILENO) != 0 ? 0. : 0.1;
}

template <class... Values>
std::string format(const char *form, Values... values)
{
  std::string text(std::snprintf(nullptr, 0, form, values...), '\0');
  std::snprintf(text.data(), text.size() + 1, form, values...);
  return text;
}

} // namespace

std::string print_duration(double seconds)
{
  const auto total = std::lround(std::clamp(seconds, 0., 1e9));
  if (total >= 3600)
    return format("%ld h %02ld min", total / 3600, total % 3600 / 60);
  if (total >= 60)
    return format("%ld min %02ld s", total / 60, total % 60);
  return format("%ld s", total);
}

ProgressLine::ProgressLine(double start_time, double end_time, std::ostream &out)
    : ProgressLine(start_time, end_time, out, pause_between_lines(out), steady_seconds)
{
}

ProgressLine::ProgressLine(double start_time, double end_time, std::ostream &out, double seconds_between_lines,
                           Clock clock)
    : start_time_(start_time),
      end_time_(end_time),
      seconds_between_lines_(seconds_between_lines),
      out_(out),
      clock_(std::move(clock)),
      recent_{{clock_(), start_time}}
{
}

std::optional<double> ProgressLine::remaining(double time) const
{
  const auto [wall_begin, time_begin] = recent_.front();
  if (time <= time_begin)
    return std::nullopt;
  return (end_time_ - time) * (recent_.back().first - wall_begin) / (time - time_begin);
}

void ProgressLine::report(const ProgressReport &report)
{
  const double now = clock_();
  recent_.emplace_back(now, report.time);
  if (recent_.size() > n_recent + 1)
    recent_.pop_front();

  // The last step may miss the end time by rounding.
  const bool is_last = report.time >= end_time_ - 1e-12 * (end_time_ - start_time_);
  if (last_line_ && now - *last_line_ < seconds_between_lines_ && !is_last)
    return;
  last_line_ = now;

  const double share = end_time_ == 0. ? 1. : report.time / end_time_;
  const auto   left  = remaining(report.time);
  out_ << format("step %5d  t %.4e  dt %.2e  newton %2d  dofs %8ld", report.step, report.time, report.dt,
                 report.newton_iterations, report.n_dofs)
       << (report.crack_length ? format("  crack %.4g", *report.crack_length) : "")
       << format("  %3.0f %%", 100. * share) << (left && !is_last ? "  " + print_duration(*left) + " left" : "")
       << std::endl;
}

} // namespace sherd
