#pragma once

#include <string>
#include <vector>

#include <sherd/base/parameter_types.h>

namespace sherd
{

/// A vector that a user writes as formulas of its components, of position and time: ["0", "1e6 * min(t, 1)"].
struct VectorFormula
{
  std::vector<Formula> components; ///< none: not given

  /// The variables of each, in this order; z is 0 in the plane.
  static std::vector<std::string> variables() { return {"x", "y", "z", "t"}; }
};

template <>
struct ParameterType<VectorFormula>
{
  static std::string describe(const VectorFormula &, const Range &)
  {
    return "a list of formulas of x, y, z, t, one for each direction of space";
  }
  static ParameterText write(const VectorFormula &value)
  {
    ParameterText text{"", {}, true};
    for (const auto &component : value.components)
      text.items.push_back({component.expression(), {}});
    return text;
  }
  static bool read(const ParameterText &text, const Range &, VectorFormula &value)
  {
    value.components.clear();
    for (const auto &item : text.items)
      {
        if (item.is_list)
          return false;
        value.components.emplace_back(item.word, VectorFormula::variables());
      }
    return text.is_list && value.components.size() <= 3;
  }
};

} // namespace sherd
