// label: unit
#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>

#include <sherd/base/progress.h>

using namespace sherd;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace
{
std::size_t n_lines(const std::string &text)
{
  return std::count(text.begin(), text.end(), '\n');
}
} // namespace

TEST_CASE("print_duration: two units at most", "[progress]")
{
  CHECK(print_duration(-1.) == "0 s");
  CHECK(print_duration(59.4) == "59 s");
  CHECK(print_duration(59.6) == "1 min 00 s");
  CHECK(print_duration(3599.) == "59 min 59 s");
  CHECK(print_duration(7500.) == "2 h 05 min");
}

TEST_CASE("ProgressLine: a line holds all that is reported", "[progress]")
{
  double             wall = 0.;
  std::ostringstream out;
  ProgressLine       line(0., 2., out, 0., [&] { return wall; });
  wall = 30.;
  line.report({7, 0.5, 0.001, 4, 122004, 0.4512});
  CHECK(out.str() == "step     7  t 5.0000e-01  dt 1.00e-03  newton  4  dofs   122004  crack 0.4512   25 %  1 min 30 s "
                     "left\n");
  out.str("");
  line.report({8, 2., 1.5, 3, 122004, std::nullopt});
  CHECK(out.str() == "step     8  t 2.0000e+00  dt 1.50e+00  newton  3  dofs   122004  100 %\n");
}

TEST_CASE("ProgressLine: the estimate follows the recent pace", "[progress]")
{
  double             wall = 0.;
  std::ostringstream out;
  ProgressLine       line(0., 100., out, 0., [&] { return wall; });
  for (int i = 1; i <= 10; ++i) // 5 units of time a second
    {
      wall += 1.;
      line.report({i, 5. * i, 5., 3, 10, {}});
    }
  CHECK_THAT(out.str(), EndsWith("10 s left\n"));
  for (int i = 1; i <= 60; ++i) // a crack runs: 0.1 units a second
    {
      wall += 1.;
      line.report({10 + i, 50. + 0.1 * i, 0.1, 3, 10, {}});
    }
  // Of the 100 units 44 remain at 10 seconds each.
  CHECK_THAT(out.str(), EndsWith("56 %  7 min 20 s left\n"));
}

TEST_CASE("ProgressLine: a restarted run counts its pace from the checkpoint and its share from zero", "[progress]")
{
  double             wall = 0.;
  std::ostringstream out;
  ProgressLine       line(5., 10., out, 0., [&] { return wall; });
  wall = 8.;
  line.report({900, 6., 1., 3, 10, {}});
  CHECK_THAT(out.str(), EndsWith("60 %  32 s left\n"));
}

TEST_CASE("ProgressLine: quick steps share lines in a log file, the first and the last are there", "[progress]")
{
  double             wall = 0.;
  std::ostringstream out;
  ProgressLine       line(0., 1., out, 0.1, [&] { return wall; });
  for (int i = 1; i <= 1000; ++i)
    {
      wall = 1e-3 * (i - 1) + 1e-9;
      line.report({i, 1e-3 * i, 1e-3, 1, 10, {}});
    }
  CHECK(n_lines(out.str()) == 11); // steps 1, 101, ... 901 and the last
  CHECK_THAT(out.str(), Contains("step     1 ") && Contains("step   101 ") && Contains("step  1000 "));

  std::ostringstream every;
  ProgressLine       terminal(0., 1., every, 0., [&] { return wall; });
  for (int i = 1; i <= 50; ++i)
    terminal.report({i, 0.01 * i, 0.01, 1, 10, {}});
  CHECK(n_lines(every.str()) == 50);
}
