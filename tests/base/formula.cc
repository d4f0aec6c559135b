// label: unit
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include <sherd/base/exceptions.h>
#include <sherd/base/formula.h>

using namespace sherd;
using Catch::Matchers::Contains;

TEST_CASE("Formula: values agree with the same expression in C++", "[formula]")
{
  const Formula f("0.1 * sin(2 * pi * t) * x^2 - (y > 1 ? e : min(x, y))", {"x", "y", "t"});
  for (const double x : {-1.5, 0., 0.7})
    for (const double y : {0.2, 3.})
      for (const double t : {0., 0.3})
        {
          const double exact =
              0.1 * std::sin(2. * std::numbers::pi * t) * x * x - (y > 1. ? std::numbers::e : std::min(x, y));
          // A few operations on numbers of order one.
          CHECK(f(x, y, t) == Approx(exact).epsilon(1e-14).margin(1e-15));
        }
}

TEST_CASE("Formula: a constant keeps its value bitwise", "[formula]")
{
  CHECK(Formula(0.1 + 0.2)() == 0.1 + 0.2);
  CHECK(Formula("3", {})() == 3.);
}

TEST_CASE("Formula: copies and moves are independent of the original", "[formula]")
{
  auto       original = std::make_unique<Formula>("x + 10 * t", std::vector<std::string>{"x", "t"});
  Formula    copy(*original), assigned(0.);
  const auto value = (*original)(1., 2.);
  assigned         = copy;
  original.reset();
  CHECK(copy(1., 2.) == value);
  const Formula moved(std::move(copy));
  CHECK(moved(3., 4.) == 43.);
  CHECK(assigned(5., 6.) == 65.);
  CHECK(assigned.expression() == "x + 10 * t");
  CHECK(assigned.variables() == std::vector<std::string>{"x", "t"});
}

TEST_CASE("Formula: bad syntax and unknown names are refused with their position", "[formula]")
{
  const std::vector<std::string> xt{"x", "t"};
  CHECK_THROWS_WITH(Formula("x + z", xt), Contains("formula of x, t") && Contains("\"z\"") && Contains("character 5"));
  for (const char *expression :
       {"", " ", "x +", "(x", "x)", "sin x", "2 x", "x, t", "x = 3", "x == t, 2", "foo(x)", "\"x\"", "x;t", "x $ t"})
    {
      INFO(expression);
      CHECK_THROWS_AS(Formula(expression, xt), InvalidParameter);
    }
  for (const char *expression : {"x == t", "x <= t", "x >= t", "x != t"})
    CHECK(Formula(expression, xt)(1., 1.) == (std::string(expression) == "x != t" ? 0. : 1.));
}

TEST_CASE("Formula: impossible names of variables are refused", "[formula]")
{
  for (const char *name : {"", "1x", "x y", "pi", "x+"})
    {
      INFO(name);
      CHECK_THROWS_AS(Formula("1", {name}), InvalidParameter);
    }
  CHECK_THROWS_AS(Formula("x", {"x", "x"}), InvalidParameter);
}

TEST_CASE("Formula: a value that is not finite is an error that names the arguments", "[formula]")
{
  const Formula inverse("1 / x", {"x", "t"}), root("sqrt(x)", {"x"});
  CHECK(inverse(2., 0.) == 0.5);
  CHECK_THROWS_AS(inverse(0., 1.5), InvalidParameter);
  CHECK_THROWS_WITH(inverse(0., 1.5), Contains("\"1 / x\" is inf at x = 0, t = 1.5"));
  CHECK_THROWS_AS(root(-1.), InvalidParameter);
  CHECK(root(4.) == 2.);
}

TEST_CASE("Formula: the number of arguments has to fit", "[formula]")
{
  const Formula f("x", {"x"});
  CHECK_THROWS_AS(f(), DimensionMismatch);
  CHECK_THROWS_AS(f(1., 2.), DimensionMismatch);
}
