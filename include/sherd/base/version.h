#pragma once

#include <string>
#include <utility>
#include <vector>

/// Which library this is.
namespace sherd
{

/// Version of the library, the same as in CMakeLists.txt.
inline constexpr const char *version = "0.1.0";

/// The library, the compiler that built it and the libraries below it: {name, version}.
std::vector<std::pair<std::string, std::string>> versions();

} // namespace sherd
