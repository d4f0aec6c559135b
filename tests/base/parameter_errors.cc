// label: unit
#include <limits>

#include <catch2/catch.hpp>

#include <sherd/base/parameters.h>

using namespace sherd;
using Catch::Matchers::Contains;
using Catch::Matchers::Equals;

namespace
{
struct Material
{
  double youngs_modulus = 100.;
  double poissons_ratio = 0.3;

  void declare(ParameterSection &section)
  {
    section.value("youngs_modulus", youngs_modulus, "Pa", range::positive(), "Young's modulus");
    section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 0.5), "Poisson's ratio");
  }
};

struct Case
{
  Material              material;
  int                   steps  = 10;
  bool                  plot   = false;
  std::string           solver = "gmres";
  std::array<double, 2> size{1., 2.};
  std::vector<double>   times{0.5};
  std::string           title;
  Formula               pressure{"0", {"x", "y"}};
  std::vector<Material> layers;

  void declare(ParameterSection &section)
  {
    section.subsection("material", material, "elastic constants");
    section.value("steps", steps, range::at_least(1), "number of steps");
    section.value("plot", plot, "draw pictures");
    section.choice("solver", solver, {"gmres", "mumps"}, "linear solver");
    section.value("size", size, "m", range::positive(), "length and width");
    section.value("times", times, "s", range::non_negative(), "times of frames");
    section.value("title", title, "title");
    section.value("pressure", pressure, "Pa", "pressure");
    section.list("layers", layers, "layers");
  }
};

void read(const std::string &text, const std::vector<std::pair<std::string, std::string>> &overrides = {})
{
  Case c;
  auto section = ParameterSection::of(c);
  read_parameters(section, text, "case.yaml", overrides);
}

std::string message(const std::string &text, const std::vector<std::pair<std::string, std::string>> &overrides = {})
{
  try
    {
      read(text, overrides);
    }
  catch (const Error &e)
    {
      return e.what();
    }
  return "no error";
}
} // namespace

TEST_CASE("Parameters: a value out of range is told with all that helps", "[parameters]")
{
  CHECK(message("# case\nmaterial:\n  poissons_ratio: 0.5\n") ==
        "material.poissons_ratio = 0.5 [-], expected a value in (-1, 0.5) (case.yaml:3:19); try 0.3");
  CHECK(
      message("", {{"material.poissons_ratio", "0.5"}}) ==
      "material.poissons_ratio = 0.5 [-], expected a value in (-1, 0.5) (--set material.poissons_ratio=0.5); try 0.3");
}

TEST_CASE("Parameters: wrong types and values are refused", "[parameters]")
{
  for (const char *text : {"steps: 2.5",
                           "steps: 0",
                           "steps: 1e3",
                           "steps: many",
                           "steps: [1]",
                           "steps:",
                           "steps: {a: 1}",
                           "steps: 99999999999",
                           "plot: yes",
                           "plot: 1",
                           "plot: [true]",
                           "solver: [gmres]",
                           "size: [1]",
                           "size: [1, 2, 3]",
                           "size: 1",
                           "size: [1, a]",
                           "size: [1, [2]]",
                           "size: [1, 0]",
                           "size: [1, {a: 2}]",
                           "times: 0.5",
                           "times: [-1]",
                           "times: [0, .nan]",
                           "title: [a]",
                           "title:",
                           "pressure: [x]",
                           "pressure: ''",
                           "layers: {}",
                           "layers: 3",
                           "layers: [3]",
                           "material: 3",
                           "material: [1]",
                           "material: {youngs_modulus: nan}",
                           "material: {youngs_modulus: .nan}",
                           "material: {youngs_modulus: .inf}",
                           "material: {youngs_modulus: 1 Pa}",
                           "material: {youngs_modulus: 1e999}"})
    {
      INFO(text);
      CHECK_THROWS_AS(read(text), InvalidParameter);
      CHECK_THAT(message(text), Contains("(case.yaml:1:"));
      CHECK_THAT(message(text), Contains("expected") || Contains("no value"));
    }
}

TEST_CASE("Parameters: an unknown key names the nearest known one, with line and column", "[parameters]")
{
  CHECK_THAT(message("steps: 3\nmaterial:\n  poisson_ratio: 0.2\n"),
             Equals("unknown parameter material.poisson_ratio (case.yaml:3:3), the nearest known one is "
                    "material.poissons_ratio; see --help"));
  CHECK_THAT(message("layers:\n  - {}\n  - youngs_modulu: 1\n"),
             Contains("unknown parameter layers.1.youngs_modulu (case.yaml:3:5)") &&
                 Contains("is layers.1.youngs_modulus;"));
  CHECK_THAT(message("", {{"materal.youngs_modulus", "1"}}),
             Contains("unknown parameter materal (--set materal.youngs_modulus=1)") && Contains("is material;"));
  CHECK_THAT(message("", {{"material.density", "1"}}), Contains("unknown parameter material.density"));
}

TEST_CASE("Parameters: a key in the wrong section is found in the right one", "[parameters]")
{
  CHECK_THAT(message("youngs_modulus: 3\n"), Contains("(case.yaml:1:1)") && Contains("is material.youngs_modulus;"));
}

TEST_CASE("Parameters: a choice lists its names", "[parameters]")
{
  CHECK(message("solver: gmress\n") ==
        "solver = gmress, expected one of gmres, mumps; nearest is gmres (case.yaml:1:9); try gmres");
}

TEST_CASE("Parameters: a formula with an error tells where it is", "[parameters]")
{
  CHECK_THAT(message("pressure: x + z\n"),
             Contains("pressure = x + z [Pa], expected a formula of x, y") && Contains("(case.yaml:1:11)"));
}

TEST_CASE("Parameters: keys given twice are refused", "[parameters]")
{
  CHECK_THAT(message("steps: 1\nplot: true\nsteps: 2\n"), Contains("steps is given twice (case.yaml:3:1)"));
}

TEST_CASE("Parameters: what is not one YAML document is a file error with its place", "[parameters]")
{
  for (const char *text : {"steps: [1", "steps: 1\n plot: true\n", "a: b: c", "title: 'x", "steps: 1\n---\nsteps: 2\n"})
    {
      INFO(text);
      CHECK_THROWS_AS(read(text), FileError);
      CHECK_THAT(message(text), Contains("case.yaml"));
    }
  CHECK_THROWS_AS(read("- a\n- b\n"), InvalidParameter);
  CHECK_THROWS_AS(read("just words\n"), InvalidParameter);
}

TEST_CASE("Parameters: overrides introduce nothing", "[parameters]")
{
  for (const auto &[key, value] : std::vector<std::pair<std::string, std::string>>{{"material", "3"},
                                                                                   {"material.", "3"},
                                                                                   {".steps", "3"},
                                                                                   {"steps.x", "3"},
                                                                                   {"steps", ""},
                                                                                   {"size", "[1, 2"},
                                                                                   {"layers.0.youngs_modulus", "1"},
                                                                                   {"layers.x.youngs_modulus", "1"},
                                                                                   {"layers.0", "{}"},
                                                                                   {"provenance.ranks", "3"}})
    {
      INFO(key << "=" << value);
      CHECK_THROWS_AS(read("", {{key, value}}), InvalidParameter);
      CHECK_THAT(message("", {{key, value}}), Contains("--set " + key + "=" + value));
    }
}

TEST_CASE("Parameters: what has no default has to be given", "[parameters]")
{
  struct Needy
  {
    double end = std::numeric_limits<double>::quiet_NaN();

    void declare(ParameterSection &section) { section.value("end", end, "s", range::positive(), "end time"); }
  };
  Needy needy;
  auto  section = ParameterSection::of(needy);
  CHECK_THROWS_WITH(read_parameters(section, "", "case.yaml"),
                    "end [s] is missing, expected a value in (0, inf); give it in the case file or by --set end=VALUE "
                    "(end time)");
  read_parameters(section, "end: 3", "case.yaml");
  CHECK(needy.end == 3.);
  CHECK_THAT(parameter_reference<Needy>(), Contains("end = (to be given) [s]"));
}

TEST_CASE("Parameters: mistakes in a declaration are found", "[parameters]")
{
  double           value = 0.;
  ParameterSection section;
  section.value("a", value, "-", range::any(), "a");
  CHECK_THROWS_AS(section.value("a", value, "-", range::any(), "again"), InvalidParameter);
  CHECK_THROWS_AS(section.value("A b", value, "-", range::any(), "no name"), InvalidParameter);
}
