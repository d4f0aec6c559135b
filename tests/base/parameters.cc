// label: unit
// ranks: 1 2 3
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <base/temporary_directory.h>
#include <catch2/catch.hpp>

#include <sherd/base/parameters.h>

using namespace sherd;
using Catch::Matchers::Contains;

namespace
{
enum class Integrator
{
  newmark,
  generalized_alpha
};

struct Material
{
  double youngs_modulus = 100.;
  double poissons_ratio = 0.3;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "Pa", range::positive(), "Young's modulus");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 0.5), "Poisson's ratio");
  }

  bool operator==(const Material &) const = default;
};

struct Load
{
  std::string            edge = "top";
  std::array<Formula, 2> traction{Formula("0", {"x", "t"}), Formula("0", {"x", "t"})};

  void declare(ParameterSection &section)
  {
    section.value("edge", edge, "name of the edge");
    section.value("traction", traction, "N/m", "force per length");
  }
};

struct Case
{
  Material                   material;
  int                        steps      = 10;
  bool                       plot       = false;
  std::string                title      = "a: \"title\" # with\nspecial \\ characters";
  Integrator                 integrator = Integrator::newmark;
  std::string                solver     = "gmres";
  std::array<double, 2>      size{1., 2.};
  std::array<int, 2>         elements{4, 8};
  std::vector<double>        times;
  std::vector<std::string>   probes{"null", "", "left top", "-", "1e3"};
  Point<3>                   gravity = {0., 0., -9.81};
  std::vector<Point<2>>      notch{{0., 0.5}, {0.2, 0.5}};
  std::optional<double>      cut;
  std::optional<std::string> file;
  Formula                    pressure{"0.1 * x > 0 ? 1 : 2", {"x", "y"}};
  std::vector<Load>          loads;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "elastic constants");
    section.value("steps", steps, range::at_least(1), "number of steps");
    section.value("plot", plot, "draw pictures");
    section.value("title", title, "title of\nthe run");
    section.choice("integrator", integrator,
                   {{"newmark", Integrator::newmark}, {"generalized_alpha", Integrator::generalized_alpha}},
                   "time integrator");
    section.choice("solver", solver, {"gmres", "mumps"}, "linear solver");
    section.value("size", size, "m", range::positive(), "length and width");
    section.value("elements", elements, range::at_least(1), "elements along each edge");
    section.value("times", times, "s", range::non_negative(), "times of frames");
    section.value("probes", probes, "names of probes");
    section.value("gravity", gravity, "m/s^2", range::any(), "acceleration");
    section.value("notch", notch, "m", range::any(), "polyline of the notch");
    section.value("cut", cut, "-", range::closed(0., 1.), "phase below which material is cut away");
    section.value("file", file, "geometry file");
    section.value("pressure", pressure, "Pa", "pressure as a function of position");
    section.list("loads", loads, "tractions");
  }
};

Case read(const std::string &text, const std::vector<std::pair<std::string, std::string>> &overrides = {}, Case c = {})
{
  auto section = ParameterSection::of(c);
  read_parameters(section, text, "case.yaml", overrides);
  return c;
}

std::string write(Case c, const Provenance &facts = {})
{
  return used_yaml(ParameterSection::of(c), facts);
}

std::uint64_t bits(double value)
{
  return std::bit_cast<std::uint64_t>(value);
}
} // namespace

TEST_CASE("Range: ends belong to the interval as its text says, NaN never", "[parameters]")
{
  CHECK(range::positive().text() == "(0, inf)");
  CHECK(range::non_negative().text() == "[0, inf)");
  CHECK(range::left_open(-1., 0.5).text() == "(-1, 0.5]");
  CHECK((range::open(0., 1.).contains(0.5) && !range::open(0., 1.).contains(0.) && !range::open(0., 1.).contains(1.)));
  CHECK((range::closed(0., 1.).contains(0.) && range::closed(0., 1.).contains(1.)));
  CHECK((range::right_open(0., 1.).contains(0.) && !range::right_open(0., 1.).contains(1.)));
  CHECK_FALSE(range::any().contains(HUGE_VAL));
  CHECK(range::closed(0., HUGE_VAL).contains(HUGE_VAL));
  for (const auto &range : {range::any(), range::closed(-1., 1.), range::at_least(0.)})
    CHECK_FALSE(range.contains(NAN));
}

TEST_CASE("Parameters: an empty case file leaves the defaults", "[parameters]")
{
  for (const char *text : {"", "# nothing\n", "material:\n", "{}"})
    {
      const auto c = read(text);
      CHECK(c.material == Material{});
      CHECK(c.steps == 10);
      CHECK(c.loads.empty());
    }
}

TEST_CASE("Parameters: values of every type arrive", "[parameters]")
{
  const auto c = read(R"(
material:
  poissons_ratio: -0.25
  youngs_modulus: 2.1e11
steps: 3
plot: true
title: 'plain'
integrator: generalized_alpha
solver: mumps
size: [0.5, 3]
elements: [1, 2]
times: [0, 0.25, 1e-3]
probes: [a, b]
gravity: [1, 2, 3]
notch: [[0, 1], [2, 3], [4, 5]]
cut: 0.01
file: plate.h5
pressure: x + 2 * y
loads:
  - edge: left
    traction: [1, x * t]
  - {}
)");
  CHECK(c.material == Material{2.1e11, -0.25});
  CHECK(c.steps == 3);
  CHECK(c.plot);
  CHECK(c.title == "plain");
  CHECK(c.integrator == Integrator::generalized_alpha);
  CHECK(c.solver == "mumps");
  CHECK(c.size == std::array<double, 2>{0.5, 3.});
  CHECK(c.elements == std::array<int, 2>{1, 2});
  CHECK(c.times == std::vector<double>{0., 0.25, 1e-3});
  CHECK(c.probes == std::vector<std::string>{"a", "b"});
  CHECK(c.gravity == Point<3>(1., 2., 3.));
  REQUIRE(c.notch.size() == 3);
  CHECK(c.notch[2] == Point<2>(4., 5.));
  CHECK(c.cut == 0.01);
  CHECK(c.file == "plate.h5");
  CHECK(c.pressure(1., 10.) == 21.);
  REQUIRE(c.loads.size() == 2);
  CHECK(c.loads[0].edge == "left");
  CHECK(c.loads[0].traction[1](3., 4.) == 12.);
  CHECK(c.loads[1].edge == "top");
}

TEST_CASE("Parameters: --set wins over the case file, the last one over earlier ones", "[parameters]")
{
  const auto c = read("steps: 3\nloads: [{edge: a}, {edge: b}]\n", {{"steps", "4"},
                                                                    {"material.youngs_modulus", "7"},
                                                                    {"steps", "5"},
                                                                    {"size", "[3, 4]"},
                                                                    {"loads.1.edge", "right"},
                                                                    {"loads.0.traction", "['x > 0 ? 1 : 2', 3]"},
                                                                    {"pressure", "x > 1 ? 5 : 6"},
                                                                    {"title", "#1: a"},
                                                                    {"cut", "0.5"},
                                                                    {"cut", "none"}});
  CHECK(c.steps == 5);
  CHECK(c.material.youngs_modulus == 7.);
  CHECK(c.size == std::array<double, 2>{3., 4.});
  CHECK(c.loads[0].edge == "a");
  CHECK(c.loads[1].edge == "right");
  CHECK(c.loads[0].traction[0](-1., 0.) == 2.);
  CHECK(c.title == "#1: a");
  CHECK(c.pressure(2., 0.) == 5.);
  CHECK_FALSE(c.cut);
  CHECK(read("", {{"loads", "[{edge: z}]"}}).loads.at(0).edge == "z");
  CHECK(read("", {{"material", "{youngs_modulus: 3}"}}).material.youngs_modulus == 3.);
}

TEST_CASE("Parameters: used.yaml reads back to the same values, numbers bitwise", "[parameters]")
{
  std::mt19937_64                  random(3);
  std::uniform_real_distribution<> uniform(-1., 1.);
  Case                             c;
  for (int i = 0; i < 200; ++i)
    c.times.push_back(std::ldexp(std::abs(uniform(random)), static_cast<int>(random() % 600) - 300));
  c.material.youngs_modulus = 1. / 3.;
  c.gravity                 = {uniform(random), -0., 1e300};
  c.cut                     = 0.1 + 0.2;
  c.integrator              = Integrator::generalized_alpha;
  c.loads.resize(2);
  c.loads[1].edge     = "links: oben";
  c.loads[1].traction = {Formula("x", {"x", "t"}), Formula("-t", {"x", "t"})};

  const auto text = write(c, {{"ranks", "3"}, {"sherd", "0.1.0"}, {"case_file", ""}});
  INFO(text);
  const auto back = read(text);
  CHECK(write(back, {{"ranks", "3"}, {"sherd", "0.1.0"}, {"case_file", ""}}) == text);
  REQUIRE(back.times.size() == c.times.size());
  for (std::size_t i = 0; i < c.times.size(); ++i)
    REQUIRE(bits(back.times[i]) == bits(c.times[i]));
  for (int i = 0; i < 3; ++i)
    CHECK(bits(back.gravity[i]) == bits(c.gravity[i]));
  CHECK(bits(*back.cut) == bits(*c.cut));
  CHECK(bits(back.material.youngs_modulus) == bits(1. / 3.));
  CHECK(back.title == c.title);
  CHECK(back.probes == c.probes);
  CHECK(back.integrator == c.integrator);
  CHECK_FALSE(back.file);
  CHECK(back.pressure.expression() == c.pressure.expression());
  CHECK(back.loads[1].edge == c.loads[1].edge);
  CHECK(back.loads[1].traction[1](0., 2.) == -2.);
}

TEST_CASE("Parameters: used.yaml says what the values mean", "[parameters]")
{
  const auto text = write({}, {{"ranks", "3"}});
  CHECK_THAT(text, Contains("  # Young's modulus [Pa], a value in (0, inf)\n  youngs_modulus: 100\n"));
  CHECK_THAT(text, Contains("# time integrator, one of newmark, generalized_alpha\nintegrator: newmark\n"));
  CHECK_THAT(text, Contains("provenance:\n  ranks: 3\n"));
}

TEST_CASE("Parameters: the reference lists name, default, unit, meaning and range", "[parameters]")
{
  const auto text = parameter_reference<Case>();
  CHECK_THAT(text, Contains("material.youngs_modulus = 100 [Pa]") && Contains("Young's modulus; a value in (0, inf)"));
  CHECK_THAT(text, Contains("integrator = newmark") && Contains("one of newmark, generalized_alpha"));
  CHECK_THAT(text, Contains("loads.0.traction = [0, 0] [N/m]") && Contains("a list of 2, each a formula of x, t"));
  CHECK_THAT(text, Contains("cut = none [-]") && Contains("a value in [0, 1] or none"));
}

TEST_CASE("Parameters: the case file reaches all ranks, and so does its absence", "[parameters]")
{
  const test::TemporaryDirectory temporary;
  CommandLine                    line;
  line.case_file = (temporary.path() / "case.yaml").string();
  line.overrides = {{"material.poissons_ratio", "0"}};
  const Environment env(MPI_COMM_WORLD, line);
  CHECK_THROWS_AS(read_parameters<Case>(env), FileError);
  CHECK_THROWS_WITH(read_parameters<Case>(env), Contains("case.yaml") && Contains("No such file"));

  write_text(env, line.case_file, "material: {youngs_modulus: 5}\n");
  const auto c = read_parameters<Case>(env);
  CHECK(c.material == Material{5., 0.});

  write_parameters(env, temporary.path() / "used.yaml", c);
  line.case_file = (temporary.path() / "used.yaml").string();
  line.overrides.clear();
  CHECK(read_parameters<Case>(Environment(MPI_COMM_WORLD, line)).material == Material{5., 0.});
  const auto text = read_text(env, temporary.path() / "used.yaml");
  CHECK_THAT(text, Contains("  ranks: " + std::to_string(env.n_ranks()) + "\n") && Contains("  sherd: "));

  write_text(env, line.case_file, "steps: none\n");
  CHECK_THROWS_AS(read_parameters<Case>(Environment(MPI_COMM_WORLD, line)), InvalidParameter);
}
