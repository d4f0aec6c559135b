#pragma once

#include <string>
#include <vector>

namespace sherd
{

/// A policy or shape that a case file names, with a line on what it is.
struct Choice
{
  std::string name, line;
};

/// All that one parameter of the case file can name.
struct ChoiceGroup
{
  std::string         parameter; ///< its path
  std::vector<Choice> choices;
};

/// Every policy and shape there is.
std::vector<ChoiceGroup> choice_groups();

/// The same as the text of --list.
std::string list_of_choices();

} // namespace sherd
