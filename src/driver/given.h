#pragma once

#include <initializer_list>
#include <string>

#include <sherd/base/exceptions.h>

namespace sherd::internal
{

/// A parameter that may be given or not.
struct Given
{
  std::string name;
  bool        is_given;
};

/// Checks that of @p parameters those are given that @p needed names, and none but those and the @p allowed ones.
/// @param where   what they belong to, for messages: "supports.0: kind = fix"
/// @throws InvalidParameter
inline void check_given(const std::string &where, const std::initializer_list<Given> &parameters,
                        const std::initializer_list<std::string> &needed,
                        const std::initializer_list<std::string> &allowed = {})
{
  const auto contains = [](const auto &names, const std::string &name) {
    for (const auto &other : names)
      if (other == name)
        return true;
    return false;
  };
  std::string list;
  for (const auto &name : needed)
    list += (list.empty() ? "" : ", ") + name;
  for (const auto &parameter : parameters)
    {
      if (!parameter.is_given && contains(needed, parameter.name))
        throw InvalidParameter(where + " needs " + list + "; " + parameter.name + " is missing");
      if (parameter.is_given && !contains(needed, parameter.name) && !contains(allowed, parameter.name))
        throw InvalidParameter(where + " has no " + parameter.name + ", which is given; " +
                               (list.empty() ? "remove it" : "it takes " + list));
    }
}

} // namespace sherd::internal
