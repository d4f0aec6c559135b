// label: unit
#include <random>

#include <catch2/catch.hpp>

#include <sherd/base/command_line.h>
#include <sherd/base/exceptions.h>
#include <sherd/base/nearest_name.h>

using namespace sherd;
using Catch::Matchers::Contains;

namespace
{
CommandLine parse(const std::vector<std::string> &arguments)
{
  return parse_command_line("step-1", arguments);
}
} // namespace

TEST_CASE("CommandLine: without arguments the defaults hold", "[command_line]")
{
  const auto line = parse({});
  CHECK(line.program == "step-1");
  CHECK(line.case_file.empty());
  CHECK(line.overrides.empty());
  CHECK(line.output_directory == "output");
  CHECK_FALSE(line.restart);
  CHECK_FALSE(line.max_wall_minutes);
  CHECK_FALSE((line.overwrite || line.check || line.profile || line.help));
}

TEST_CASE("CommandLine: every option arrives, in both forms and any order", "[command_line]")
{
  const auto line = parse({"--set", "a.b=-1", "--output", "out dir", "case.yaml", "--set=c=x=y", "--restart",
                           "old/checkpoint.h5", "--check", "--max-wall=0.5", "--help"});
  CHECK(line.case_file == "case.yaml");
  REQUIRE(line.overrides.size() == 2);
  CHECK(line.overrides[0] == std::pair<std::string, std::string>("a.b", "-1"));
  CHECK(line.overrides[1] == std::pair<std::string, std::string>("c", "x=y"));
  CHECK(line.output_directory == "out dir");
  CHECK(line.restart == "old/checkpoint.h5");
  CHECK(line.max_wall_minutes == 0.5);
  CHECK((line.check && line.help && !line.overwrite));
  CHECK(parse({"--overwrite"}).overwrite);
  CHECK(parse({"--profile"}).profile);
}

TEST_CASE("CommandLine: a restart goes on where its checkpoint is", "[command_line]")
{
  CHECK(parse({"--restart", "out/demo/checkpoint.h5"}).output_directory == "out/demo");
  CHECK(parse({"--restart", "checkpoint.h5"}).output_directory == ".");
  CHECK(parse({"--restart", "out/checkpoint.h5", "--output", "output"}).output_directory == "output");
}

TEST_CASE("CommandLine: an unknown option names the nearest known one", "[command_line]")
{
  CHECK_THROWS_WITH(parse({"--outptu", "x"}), Contains("unknown option --outptu") && Contains("is --output;"));
  CHECK_THROWS_WITH(parse({"--maxwall=3"}), Contains("is --max-wall;"));
  CHECK_THROWS_WITH(parse({"-h"}), Contains("unknown option -h"));
  CHECK_THROWS_AS(parse({"--outptu"}), InvalidParameter);
}

TEST_CASE("CommandLine: malformed input is refused, never guessed", "[command_line]")
{
  for (const auto &arguments : std::vector<std::vector<std::string>>{{"--set"},
                                                                     {"--set", "no_equals"},
                                                                     {"--set", "=3"},
                                                                     {"--output"},
                                                                     {"--output", "--check"},
                                                                     {"--output="},
                                                                     {"--max-wall", "soon"},
                                                                     {"--max-wall", "-1"},
                                                                     {"--max-wall", "0"},
                                                                     {"--max-wall", "nan"},
                                                                     {"--max-wall", "inf"},
                                                                     {"--check=yes"},
                                                                     {"--check", "--check"},
                                                                     {"--output", "a", "--output", "b"},
                                                                     {"a.yaml", "b.yaml"},
                                                                     {""},
                                                                     {"--restart", "f", "--overwrite"}})
    {
      INFO(Catch::StringMaker<std::vector<std::string>>::convert(arguments));
      CHECK_THROWS_AS(parse(arguments), InvalidParameter);
    }
}

TEST_CASE("CommandLine: the usage names the program and every option", "[command_line]")
{
  CHECK_THAT(usage("step-7"), Contains("usage: step-7 [case.yaml]"));
  for (const char *option : {"--set section.key=value", "--output DIR", "--restart FILE", "--overwrite", "--check",
                             "--max-wall MINUTES", "--profile", "--help"})
    CHECK_THAT(usage("step-7"), Contains(std::string("[") + option + "]") && Contains(std::string("\n  ") + option));
}

TEST_CASE("edit_distance: known values", "[nearest_name]")
{
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("ab", "ba") == 1);
  CHECK(edit_distance("ca", "abc") == 3); // optimal string alignment: no letter is edited twice
}

TEST_CASE("edit_distance: symmetric, bounded by the longer word, at least the difference in length", "[nearest_name]")
{
  std::mt19937 random(5);
  const auto   word = [&] {
    std::string text(random() % 8, ' ');
    for (auto &c : text)
      c = static_cast<char>('a' + random() % 3);
    return text;
  };
  for (int i = 0; i < 500; ++i)
    {
      const auto a = word(), b = word();
      const int  d = edit_distance(a, b), m = static_cast<int>(a.size()), n = static_cast<int>(b.size());
      INFO(a << " / " << b);
      REQUIRE(d == edit_distance(b, a));
      REQUIRE((d == 0) == (a == b));
      REQUIRE(d >= std::abs(m - n));
      REQUIRE(d <= std::max(m, n));
    }
}

TEST_CASE("nearest_name: the closest candidate, the first among equals", "[nearest_name]")
{
  const std::vector<std::string> names{"youngs_modulus", "poissons_ratio", "density"};
  CHECK(nearest_name("poisson_ratio", names) == "poissons_ratio");
  CHECK(nearest_name("densty", names) == "density");
  CHECK(nearest_name("b", std::vector<std::string>{"a", "c"}) == "a");
  CHECK(nearest_name("b", {}).empty());
}
