// label: verification
#include <catch2/catch.hpp>

#include <string>
#include <tuple>

#include <yaml-cpp/yaml.h>

#include <sherd/spline/independence.h>

#include "spline_tools.h"

// Data sets of another implementation, see tests/reference/lr/README.md.

using namespace sherd;

namespace
{

YAML::Node load(const std::string &name)
{
  return YAML::LoadFile(std::string(SHERD_TEST_DATA) + "/lr/" + name + ".json");
}

std::vector<MeshLine> mesh_lines(const YAML::Node &nodes)
{
  std::vector<MeshLine> lines;
  for (const auto &node : nodes)
    lines.push_back({node["direction"].as<std::string>() == "u" ? Direction::u : Direction::v,
                     node["value"].as<double>(), node["start"].as<double>(), node["end"].as<double>(),
                     node["multiplicity"].as<int>()});
  return lines;
}

template <int degree>
LRBasis<degree> initial_basis(const YAML::Node &data)
{
  return {data["initial_knots_u"].as<std::vector<double>>(), data["initial_knots_v"].as<std::vector<double>>()};
}

/// Lines inserted one by one in the order of the file.
template <int degree>
LRBasis<degree> replayed(const YAML::Node &data)
{
  auto basis = initial_basis<degree>(data);
  for (const auto &line : mesh_lines(data["insertions"]))
    basis.insert(std::array{line});
  return basis;
}

/// For each function of the basis its number in the file.
template <int degree>
std::vector<int> numbers_in_file(const LRBasis<degree> &basis)
{
  std::vector<int> order(basis.n_functions()), number(basis.n_functions());
  for (int i = 0; i < basis.n_functions(); ++i)
    order[i] = i;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto &f = basis.function(a).knots, &g = basis.function(b).knots;
    return std::tie(f[1], f[0]) < std::tie(g[1], g[0]);
  });
  for (int k = 0; k < basis.n_functions(); ++k)
    number[order[k]] = k;
  return number;
}

template <int degree>
void check_lines(const LRBasis<degree> &basis, const YAML::Node &data)
{
  auto       lines    = basis.mesh_lines();
  auto       expected = mesh_lines(data["final_meshlines"]);
  const auto before   = [](const MeshLine &a, const MeshLine &b) {
    return std::tie(a.direction, a.value, a.start, a.end, a.multiplicity) <
           std::tie(b.direction, b.value, b.start, b.end, b.multiplicity);
  };
  std::sort(lines.begin(), lines.end(), before);
  std::sort(expected.begin(), expected.end(), before);
  CHECK(lines == expected);
}

template <int degree>
void check_elements(const LRBasis<degree> &basis, const YAML::Node &data)
{
  const auto number = numbers_in_file(basis);
  REQUIRE(basis.n_elements() == data["n_elements"].as<int>());
  for (const auto &node : data["elements"])
    {
      const auto box = node["box"].as<std::array<double, 4>>();
      const int  e   = basis.element_at(0.5 * (box[0] + box[2]), 0.5 * (box[1] + box[3]));
      REQUIRE(basis.element(e) == Box{{box[0], box[1]}, {box[2], box[3]}});
      std::vector<int> support;
      for (const int i : basis.functions_of(e))
        support.push_back(number[i]);
      std::sort(support.begin(), support.end());
      CHECK(support == node["support"].as<std::vector<int>>());
    }
}

template <int degree>
void check_functions(const LRBasis<degree> &basis, const YAML::Node &data)
{
  const auto functions = test::sorted_functions(basis);
  REQUIRE(functions.size() == data["n_basis"].as<std::size_t>());
  for (const auto &node : data["basis"])
    {
      const auto &function = functions.at(node["index"].as<int>());
      CHECK(function.knots[0] == node["knots_u"].as<LocalKnots<degree>>());
      CHECK(function.knots[1] == node["knots_v"].as<LocalKnots<degree>>());
      CHECK(std::abs(function.gamma - node["gamma"].as<double>()) < 2e-15); // the data are good to 5e-16
    }
}

template <int degree>
void check_values(const LRBasis<degree> &basis, const YAML::Node &data)
{
  const auto number = numbers_in_file(basis);
  REQUIRE(data["evaluations"].size() == 20);
  for (const auto &node : data["evaluations"])
    {
      const auto point     = node["point"].as<std::array<double, 2>>();
      const int  e         = basis.element_at(point[0], point[1]);
      const auto functions = basis.functions_of(e);
      const auto values    = evaluate(basis, e, point[0], point[1]);
      const auto size      = basis.element(e).size();
      REQUIRE(node["functions"].size() == functions.size());
      for (const auto &entry : node["functions"])
        {
          std::size_t k = 0;
          while (k < functions.size() && number[functions[k]] != entry["index"].as<int>())
            ++k;
          REQUIRE(k < functions.size());
          const auto  expected = entry["N_Nu_Nv_Nuu_Nuv_Nvv"].as<std::array<double, 6>>();
          const auto &f        = values[k];
          // Rounding of the file and of two different recurrences; a derivative is larger by degree / size.
          const double tolerance = 1e-14, in_u = degree / size[0], in_v = degree / size[1];
          CHECK(std::abs(f.value - expected[0]) < tolerance);
          CHECK(std::abs(f.first[0] - expected[1]) < tolerance * in_u);
          CHECK(std::abs(f.first[1] - expected[2]) < tolerance * in_v);
          CHECK(std::abs(f.second[0] - expected[3]) < tolerance * in_u * in_u);
          CHECK(std::abs(f.second[2] - expected[4]) < tolerance * in_u * in_v);
          CHECK(std::abs(f.second[1] - expected[5]) < tolerance * in_v * in_v);
        }
    }
}

template <int degree>
void check_all(const std::string &name)
{
  CAPTURE(name);
  const auto data  = load(name);
  const auto basis = replayed<degree>(data);
  REQUIRE(data["degree"].as<std::vector<int>>() == std::vector{degree, degree});

  check_lines(basis, data);
  check_elements(basis, data);
  check_functions(basis, data);
  check_values(basis, data);
  const auto independence = check_independence(basis);
  CHECK(independence.independent());
  CHECK(independence.left_after_peeling.empty() == data["linearly_independent_by_overloading"].as<bool>());
  CHECK(data["collocation_gram_rank"].as<int>() == basis.n_functions());

  auto at_once = initial_basis<degree>(data);
  at_once.insert(mesh_lines(data["insertions"]));
  CHECK(test::difference(basis, at_once) < 1e-15);
}

/// The function with these integer multiples of h as knots in both directions.
template <int degree>
int function_with_knots(const LRBasis<degree> &basis, double h, const std::array<int, degree + 2> &along_u,
                        const std::array<int, degree + 2> &along_v)
{
  for (int i = 0; i < basis.n_functions(); ++i)
    {
      bool equal = true;
      for (int k = 0; k < degree + 2; ++k)
        equal =
            equal && basis.function(i).knots[0][k] == h * along_u[k] && basis.function(i).knots[1][k] == h * along_v[k];
      if (equal)
        return i;
    }
  return -1;
}

} // namespace

TEST_CASE("Reference data: mesh, functions, weights, values and derivatives agree", "[spline][lr]")
{
  check_all<2>("p22_cross");
  check_all<2>("p22_diagonal");
  check_all<2>("p22_diagonal_reordered");
  check_all<3>("p33_corner");
  check_all<3>("p33_merge_multiplicity");
}

TEST_CASE("Reference data: the order of insertion does not matter", "[spline][lr]")
{
  const auto one = replayed<2>(load("p22_diagonal")), other = replayed<2>(load("p22_diagonal_reordered"));

  CHECK(test::difference(one, other) < 1e-15);
}

TEST_CASE("Reference data: refine() makes the lines of the structured mesh along a diagonal", "[spline][lr]")
{
  auto basis = initial_basis<2>(load("p22_diagonal"));

  std::vector<int> marked;
  for (int i = 0; i <= 5; ++i)
    marked.push_back(function_with_knots<2>(basis, 1., {i, i + 1, i + 2, i + 3}, {i, i + 1, i + 2, i + 3}));
  basis.refine(marked, {{0.5, 0.5}});
  marked.clear();
  for (int i = 2; i <= 12; ++i)
    if (const int f = function_with_knots<2>(basis, 0.5, {i, i + 1, i + 2, i + 3}, {i, i + 1, i + 2, i + 3}); f >= 0)
      marked.push_back(f);
  REQUIRE(!marked.empty());
  basis.refine(marked, {{0.25, 0.25}});

  check_lines(basis, load("p22_diagonal"));
  check_functions(basis, load("p22_diagonal"));
}

TEST_CASE("Reference data: refine() makes the lines of the structured mesh at a corner", "[spline][lr]")
{
  auto                                    basis = initial_basis<3>(load("p33_corner"));
  const std::array<std::array<int, 5>, 3> knots{{{0, 0, 0, 0, 1}, {0, 0, 0, 1, 2}, {0, 0, 1, 2, 3}}};

  for (const double h : {1., 0.5, 0.25})
    {
      std::vector<int> marked;
      for (const auto &along_u : knots)
        for (const auto &along_v : knots)
          marked.push_back(function_with_knots<3>(basis, h, along_u, along_v));
      basis.refine(marked, {{0.5 * h, 0.5 * h}});
    }

  check_lines(basis, load("p33_corner"));
  check_functions(basis, load("p33_corner"));
}
