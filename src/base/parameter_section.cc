#include <sherd/base/parameter_section.h>

#include <algorithm>

#include <sherd/base/nearest_name.h>

namespace sherd
{

ParameterText ParameterType<double>::write(double value)
{
  auto word = print(value);
  if (const auto inf = word.find("inf"); inf != word.npos)
    word.insert(inf, 1, '.');
  // YAML 1.1 readers take 1e-06 for a text and 1.0e-06 for a number.
  else if (const auto exponent = word.find('e'); exponent != word.npos && word.find('.') == word.npos)
    word = word.substr(0, exponent) + ".0" + word.substr(exponent);
  return {word, {}};
}

std::string ParameterType<Formula>::describe(const Formula &example, const Range &)
{
  std::string text = "a formula";
  for (std::size_t i = 0; i < example.variables().size(); ++i)
    text += (i == 0 ? " of " : ", ") + example.variables()[i];
  return text;
}

ParameterSection::ParameterSection(std::string name, std::string meaning)
    : name_(std::move(name)), meaning_(std::move(meaning))
{
}

void ParameterSection::choice(std::string name, std::string &member, const std::vector<std::string> &names,
                              std::string meaning)
{
  std::vector<std::pair<std::string, std::string>> choices;
  for (const auto &text : names)
    choices.emplace_back(text, text);
  choice<std::string>(std::move(name), member, std::move(choices), std::move(meaning));
}

void ParameterSection::add_choice(std::string name, const std::vector<std::string> &names, std::string meaning,
                                  const std::function<std::size_t()> &get, const std::function<void(std::size_t)> &set)
{
  check_new(name);
  std::string expected = "one of ";
  for (const auto &choice : names)
    expected += (&choice == &names.front() ? "" : ", ") + choice;

  entries_.emplace_back(Parameter{std::move(name), "", std::move(meaning), expected,
                                  [names, get]() -> ParameterText {
                                    const auto i = get();
                                    return {i < names.size() ? names[i] : "?", {}};
                                  },
                                  [names, set, expected](const ParameterText &text) {
                                    const auto found = std::find(names.begin(), names.end(), text.word);
                                    if (text.is_list || found == names.end())
                                      throw InvalidParameter("expected " + expected + "; nearest is " +
                                                             nearest_name(text.word, names));
                                    set(found - names.begin());
                                  }});
}

void ParameterSection::check_new(const std::string &name) const
{
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_letter))
    throw InvalidParameter("parameter \"" + name + "\" is declared, expected a name of a-z, 0-9 and _");
  for (const auto &entry : entries_)
    if (sherd::name(entry) == name)
      throw InvalidParameter("parameter \"" + name + "\" is declared twice in section \"" + name_ + "\"");
}

const std::string &name(const ParameterSection::Entry &entry)
{
  if (const auto *parameter = std::get_if<Parameter>(&entry))
    return parameter->name;
  if (const auto *list = std::get_if<ParameterList>(&entry))
    return list->name;
  return std::get<ParameterSection>(entry).name();
}

} // namespace sherd
