#pragma once

#include <string>

#include <sherd/base/parameters.h>
#include <sherd/driver/case.h>

namespace sherd::test
{

/// What a case file of the smallest kind has to say, for lines to be added.
inline const std::string smallest_case = "fracture: {length_scale: 0.1}\n"
                                         "time: {end: 1, steps: {initial: 0.1}}\n"
                                         "refinement: {target: 0.05}\n";

inline Case read_case(const std::string &text)
{
  Case prm;
  auto section = ParameterSection::of(prm);
  read_parameters(section, text, "case.yaml");
  return prm;
}

/// The message of the InvalidParameter that @p action throws, empty if it does not.
template <class Action>
std::string refusal(const Action &action)
{
  try
    {
      action();
    }
  catch (const InvalidParameter &error)
    {
      return error.what();
    }
  return "";
}

} // namespace sherd::test
