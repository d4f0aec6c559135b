#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>

#include "spline_tools.h"

using namespace sherd;

namespace
{

template <int degree>
LRBasis<degree> refined_basis(int n_refinements, std::mt19937 &generator)
{
  LRBasis<degree> basis(test::open_knots(degree, {0., 1., 1.5, 3., 3., 4.}),
                        test::open_knots(degree, {-1., 0., 0.7, 2.}));
  for (int k = 0; k < n_refinements; ++k)
    {
      basis.refine(test::random_functions(basis, 0.1, generator), {{0.1, 0.1}});
      const std::vector<MeshLine> lines{test::random_line(basis, degree, generator),
                                        test::random_line(basis, 1, generator)};
      basis.insert(lines);
    }
  return basis;
}

template <int degree>
void check_same(const LRBasis<degree> &a, const LRBasis<degree> &b)
{
  REQUIRE(a.initial_knots() == b.initial_knots());
  REQUIRE(a.mesh_lines() == b.mesh_lines());
  REQUIRE(a.n_functions() == b.n_functions());
  REQUIRE(a.n_elements() == b.n_elements());
  const auto values = [](std::span<const int> list) { return std::vector<int>(list.begin(), list.end()); };
  for (int i = 0; i < a.n_functions(); ++i)
    {
      REQUIRE(a.function(i).knots == b.function(i).knots);
      REQUIRE(a.function(i).gamma == b.function(i).gamma);
      REQUIRE(values(a.elements_of(i)) == values(b.elements_of(i)));
    }
  for (int e = 0; e < a.n_elements(); ++e)
    {
      REQUIRE(a.element(e) == b.element(e));
      REQUIRE(values(a.functions_of(e)) == values(b.functions_of(e)));
      const auto [u, v] = a.element(e).centre();
      REQUIRE(b.element_at(u, v) == e);
    }
}

template <int degree>
std::string refusal(const LRBasisParts<degree> &parts)
{
  try
    {
      const LRBasis<degree> basis(parts);
    }
  catch (const InvalidParameter &error)
    {
      return error.what();
    }
  return "";
}

} // namespace

TEMPLATE_TEST_CASE_SIG("LRBasis: is the same again from its parts, and after later refinements", "[spline]",
                       ((int degree), degree), 2, 3, 4)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
    {
      std::mt19937    generator(seed);
      auto            basis = refined_basis<degree>(3, generator);
      LRBasis<degree> rebuilt(basis.parts());
      check_same(basis, rebuilt);

      for (int k = 0; k < 2; ++k)
        {
          const auto marked = test::random_functions(basis, 0.05, generator);
          const auto line   = std::vector{test::random_line(basis, 1, generator)};
          for (const bool by_functions : {true, false})
            {
              const auto wanted = by_functions ? basis.refine(marked, {{0.05, 0.05}}) : basis.insert(line);
              const auto found  = by_functions ? rebuilt.refine(marked, {{0.05, 0.05}}) : rebuilt.insert(line);
              REQUIRE(found.parent == wanted.parent);
              REQUIRE(found.transfer.offsets == wanted.transfer.offsets);
              REQUIRE(found.transfer.columns == wanted.transfer.columns);
              REQUIRE(found.transfer.values == wanted.transfer.values);
              check_same(basis, rebuilt);
            }
        }
    }
}

TEST_CASE("LRBasis: parts that do not belong together are refused", "[spline]")
{
  std::mt19937 generator(7);
  const auto   good = refined_basis<2>(2, generator).parts();
  REQUIRE(refusal(good).empty());
  const auto n_functions = good.functions.size(), n_elements = good.elements.size();

  auto parts = good;
  std::swap(parts.elements[n_elements / 2], parts.elements[n_elements / 2 + 1]);
  CHECK_FALSE(refusal(parts).empty());

  parts = good;
  parts.elements.pop_back();
  CHECK_FALSE(refusal(parts).empty());

  parts = good;
  parts.elements[3].max[0] += 1e-9;
  CHECK_FALSE(refusal(parts).empty());

  parts = good;
  parts.functions.erase(parts.functions.begin() + n_functions / 2);
  CHECK_FALSE(refusal(parts).empty());

  parts = good;
  parts.functions[n_functions / 2].gamma *= 1. - 1e-6;
  CHECK_FALSE(refusal(parts).empty());

  parts                              = good;
  parts.functions[0].knots[0].back() = -1.;
  CHECK_FALSE(refusal(parts).empty());

  parts = good;
  parts.lines.erase(parts.lines.begin() + parts.lines.size() / 2);
  CHECK_FALSE(refusal(parts).empty());

  parts                     = good;
  parts.initial_knots[1][0] = -2.;
  CHECK_FALSE(refusal(parts).empty());
}
