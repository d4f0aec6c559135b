// label: unit
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

#include <sherd/base/version.h>

using namespace sherd;

TEST_CASE("version: the header and the build system agree", "[version]")
{
  std::ifstream      file(SHERD_TEST_DATA "/../../CMakeLists.txt");
  std::ostringstream text;
  text << file.rdbuf();
  REQUIRE(text.str().find("project(sherd VERSION ") != std::string::npos);
  CHECK(text.str().find(std::string("project(sherd VERSION ") + version + " ") != std::string::npos);
}

TEST_CASE("version: every library has one", "[version]")
{
  CHECK(versions().front() == std::pair<std::string, std::string>("sherd", version));
  for (const auto &[name, number] : versions())
    {
      CHECK_FALSE(name.empty());
      CHECK_FALSE(number.empty());
    }
}
