#include <catch2/catch.hpp>

#include <sherd/driver/list_of_choices.h>

#include "read_case.h"

using namespace sherd;
using namespace sherd::test;
using Catch::Matchers::Contains;

namespace
{

const std::string material = "material: {constants: surface, youngs_modulus: 10, poissons_ratio: 0.3}\n";

Case resolved(const std::string &text)
{
  auto prm = read_case(smallest_case + text);
  prm.resolve();
  return prm;
}

std::string refusal_of(const std::string &text)
{
  return refusal([&] { resolved(text); });
}

} // namespace

TEST_CASE("A case file fills defaults and puts names in their place")
{
  const auto plane = resolved(material);
  CHECK(plane.material.membrane == "neo_hooke");
  CHECK(plane.material.bending == "none");

  const std::string shell = "surface: {dimension: 3}\nmaterial: {constants: solid, youngs_modulus: 10, poissons_ratio: "
                            "0.3, thickness: 0.1, split: ";
  CHECK(resolved(shell + "surface_stretch}\n").material.bending == "canham");
  CHECK(resolved(shell + "spectral_membrane}\n").material.bending == "koiter");
  CHECK(resolved(shell + "spectral_layer}\n").material.membrane == "st_venant_kirchhoff");
  CHECK(resolved(shell + "none, membrane: st_venant_kirchhoff}\n").material.bending == "koiter");
}

TEST_CASE("What a case used reads back as the same case")
{
  auto       prm  = resolved(material + "surface: {shape: polygon, polygon: {sides: 6}}\n"
                                               "loads: [{edges: [outer], vector: [\"x * t\", \"min(1, t)\"]}]\n"
                                               "supports: [{kind: prescribe, edges: [outer], component: x, displacement: 2*t}]\n"
                                               "cracks: [{points: [[0, 0], [0.1, 0.2]]}]\n");
  const auto text = used_yaml(ParameterSection::of(prm), {});
  CHECK_THAT(text, Contains("polygon"));
  CHECK_THAT(text, !Contains("tube_radius")); // sections of other shapes are left out
  auto again = read_case(text);
  again.resolve();
  CHECK(used_yaml(ParameterSection::of(again), {}) == text);
}

TEST_CASE("Constants that are missing or given in vain are named")
{
  CHECK_THAT(refusal_of("material: {constants: surface, youngs_modulus: 10}\n"),
             Contains("poissons_ratio is missing") && Contains("constants = surface"));
  CHECK_THAT(refusal_of("material: {constants: lame, first_lame: 1, shear_modulus: 1, youngs_modulus: 2}\n"),
             Contains("has no youngs_modulus"));
  CHECK_THAT(refusal_of("surface: {dimension: 3}\nmaterial: {constants: plane_strain, youngs_modulus: 1, "
                        "poissons_ratio: 0}\n"),
             Contains("plane_strain") && Contains("solid"));
}

TEST_CASE("Laws that a split does not take, and settings without effect, are refused")
{
  const auto with = [](const std::string &words) {
    return refusal_of("material: {constants: surface, youngs_modulus: 10, poissons_ratio: 0.3, " + words + "}\n");
  };
  CHECK_THAT(with("membrane: st_venant_kirchhoff"), Contains("surface_stretch") && Contains("takes neo_hooke"));
  CHECK_THAT(with("bending: koiter"), Contains("in the plane takes none"));
  CHECK_THAT(with("bending_part: passive"), Contains("surface_stretch and spectral_membrane in space"));
  CHECK_THAT(with("cut: kept"), Contains("layer_metric, cut and cut_tangent"));
  CHECK_THAT(with("layer_points: 3"), Contains("layer_points"));
}

TEST_CASE("Sections of other shapes and shapes of space in the plane are refused")
{
  CHECK_THAT(refusal_of(material + "surface: {shape: plate, torus: {tube_radius: 0.5}}\n"),
             Contains("surface.torus is given") && Contains("shape = plate"));
  CHECK_THAT(refusal_of(material + "surface: {shape: sphere}\n"), Contains("surface.dimension = 3"));
}

TEST_CASE("Integrators and solvers that do not belong together are refused")
{
  const auto with = [](const std::string &time, const std::string &rest) {
    return refusal([&] {
      auto prm = read_case("fracture: {length_scale: 0.1}\nrefinement: {target: 0.05}\n" + material +
                           "time: {end: 1, steps: {initial: 0.1}, " + time + "}\n" + rest);
      prm.resolve();
    });
  };
  CHECK(with("integrator: bathe", "") == "");
  CHECK(with("integrator: central_difference", "solver: explicit\n") == "");
  CHECK_THAT(with("integrator: central_difference", ""), Contains("belong together"));
  CHECK(with("integrator: quasi_static", "solver: arc_length\n") == "");
  CHECK_THAT(with("integrator: bathe", "solver: arc_length\n"), Contains("use quasi_static"));
  CHECK(with("integrator: bathe", "solver: modes\n") == "");
  CHECK(with("integrator: quasi_static", "solver: arc_length\nstop: {steps: 3}\n") == "");
  CHECK_THAT(with("integrator: bathe", "solver: modes\nstop: {steps: 3}\n"), Contains("solvers that take steps"));
  CHECK_THAT(with("integrator: bathe", "solver: modes\nsurface: {continuity: {method: lagrange_multiplier}}\n"),
             Contains("multipliers have no mass"));
  CHECK_THAT(with("integrator: bathe", "stop: {threshold: 0.2}\n"), Contains("belongs to stop.crack_at"));
  CHECK(with("integrator: central_difference, damping: 0.05", "solver: explicit\n") == "");
  CHECK_THAT(with("integrator: bathe, damping: 0.05", ""), Contains("has no damping"));
  CHECK_THAT(with("integrator: bathe", "solver: modes\nstop: {crack_length: 1}\n"), Contains("no crack grows"));
  CHECK_THAT(with("integrator: hht, rho_inf: 0.5", ""), Contains("has no rho_inf"));
  CHECK_THAT(with("integrator: newmark, beta: 0.1", ""), Contains("beta"));

  // What has no inertia has no error in time, and steps by it would grow without end.
  const auto by_error = [](const std::string &integrator) {
    return refusal([&] {
      read_case("fracture: {length_scale: 0.1}\nrefinement: {target: 0.05}\n" + material +
                "time: {end: 1, integrator: " + integrator + ", steps: {initial: 0.1, rule: error}}\n")
          .resolve();
    });
  };
  CHECK(by_error("bathe") == "");
  CHECK_THAT(by_error("quasi_static"), Contains("rule = error") && Contains("newton or fixed"));
}

TEST_CASE("Degradation functions take their own parameters only")
{
  const auto with = [](const std::string &words) {
    return refusal([&] {
      auto prm = read_case("fracture: {length_scale: 0.1, degradation: {" + words + "}}\n" + material +
                           "time: {end: 1, steps: {initial: 0.1}}\nrefinement: {target: 0.05}\n");
      prm.resolve();
    });
  };
  CHECK(with("function: quartic, slope: 1e-3, residual: 1e-8") == "");
  CHECK_THAT(with("function: quadratic, slope: 1"), Contains("has no slope"));
  CHECK_THAT(with("function: rational"), Contains("slope is missing"));
  CHECK_THAT(with("shape: 0.5"), Contains("has no shape"));
}

TEST_CASE("Unknown keys and values in wrong places come with line and nearest name")
{
  CHECK_THAT(refusal([] { read_case("fracture:\n  tougness: 3\n"); }),
             Contains("case.yaml:2:3") && Contains("toughness"));
  CHECK_THAT(refusal([] { read_case("material:\n  split: spectral\n"); }),
             Contains("case.yaml:2") && Contains("spectral_layer"));
  CHECK_THAT(refusal([] { read_case(smallest_case + "loads: [{vector: [\"sin(q)\"]}]\n"); }), Contains("sin(q)"));
}

TEST_CASE("The list names exactly the choices that case files have")
{
  Case                                                                     prm;
  std::vector<std::pair<std::string, std::string>>                         declared; // path, "one of a, b"
  const std::function<void(const ParameterSection &, const std::string &)> collect =
      [&](const ParameterSection &section, const std::string &path) {
        for (const auto &entry : section.entries())
          if (const auto *value = std::get_if<Parameter>(&entry))
            declared.emplace_back(path + value->name, value->expected);
          else if (const auto *list = std::get_if<ParameterList>(&entry))
            collect(list->example(), path + list->name + ".");
          else
            collect(std::get<ParameterSection>(entry), path + name(entry) + ".");
      };
  collect(ParameterSection::of(prm), "");
  for (const auto &group : choice_groups())
    {
      INFO(group.parameter);
      const auto found = std::find_if(declared.begin(), declared.end(),
                                      [&](const auto &value) { return value.first == group.parameter; });
      REQUIRE(found != declared.end());
      std::string expected = found->second + ", ";
      for (const auto &choice : group.choices)
        {
          const auto place = (", " + expected.substr(7)).find(", " + choice.name + ",");
          CHECK(place != std::string::npos);
          CHECK(!choice.line.empty());
        }
      const auto n =
          std::count(expected.begin(), expected.end(), ',') - (expected.find(" default,") != std::string::npos ? 1 : 0);
      CHECK(n == static_cast<long>(group.choices.size()));
    }
}
