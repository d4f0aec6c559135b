// label: unit
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include <sherd/base/print.h>

using namespace sherd;

TEST_CASE("print: every double reads back bitwise equal", "[print]")
{
  std::mt19937_64 random(11);
  for (int i = 0; i < 20000; ++i)
    {
      const auto value = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
      if (std::isnan(value))
        continue;
      const auto back = parse_double(print(value));
      INFO(print(value));
      REQUIRE(back);
      REQUIRE(std::bit_cast<std::uint64_t>(*back) == std::bit_cast<std::uint64_t>(value));
    }
  for (const double value : {0., -0., 0.1, std::numeric_limits<double>::denorm_min(), HUGE_VAL, -HUGE_VAL})
    CHECK(std::bit_cast<std::uint64_t>(*parse_double(print(value))) == std::bit_cast<std::uint64_t>(value));
  CHECK(print(0.1) == "0.1");
}

TEST_CASE("parse_double: takes whole numbers in all their forms and nothing else", "[print]")
{
  CHECK(parse_double("1e-3") == 1e-3);
  CHECK(parse_double(" +2.5 ") == 2.5);
  CHECK(parse_double("-.inf") == -HUGE_VAL);
  for (const char *text : {"", " ", "+", "+-1", "1,5", "1.0x", "0x10", "1 2", "1e999", "."})
    {
      INFO(text);
      CHECK_FALSE(parse_double(text));
    }
}

TEST_CASE("parse_int: refuses fractions, exponents and overflow", "[print]")
{
  CHECK(parse_int("-12") == -12);
  CHECK(parse_int("+7") == 7);
  for (const char *text : {"2.0", "1e3", "3000000000", "", "a", "1-"})
    {
      INFO(text);
      CHECK_FALSE(parse_int(text));
    }
}
