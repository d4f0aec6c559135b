#include <algorithm>

#include <omp.h>

#include <sherd/base/parameters.h>
#include <sherd/base/version.h>

namespace sherd
{
namespace
{

std::string bracketed(const std::string &unit)
{
  return unit.empty() ? "" : " [" + unit + "]";
}

std::string one_line(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// True for words that mean the same with and without quotes to every YAML reader that takes them as text or number.
bool is_plain(const std::string &word)
{
  const auto is_inner = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '.' || c == '-' || c == '+'; };
  const auto first    = word.find_first_not_of("+-.");
  if (first == word.npos || first > 2 || !std::all_of(word.begin(), word.end(), is_inner))
    return false;
  return word != "null" && word != "Null" && word != "NULL";
}

std::string quoted(const std::string &word)
{
  constexpr std::string_view digits = "0123456789abcdef";
  std::string                text;
  for (const unsigned char c : word)
    if (c == '"' || c == '\\')
      text += {'\\', static_cast<char>(c)};
    else if (c < 0x20)
      text += {'\\', 'x', digits[c / 16], digits[c % 16]};
    else
      text += static_cast<char>(c);
  return "\"" + text + "\"";
}

std::string yaml(const ParameterText &text)
{
  if (!text.is_list)
    return is_plain(text.word) ? text.word : quoted(text.word);
  std::string items;
  for (const auto &item : text.items)
    items += (items.empty() ? "" : ", ") + yaml(item);
  return "[" + items + "]";
}

void write_section(const ParameterSection &section, const std::string &indent, std::string &out);

void write_list(const ParameterList &list, const std::string &indent, std::string &out)
{
  out += indent + list.name + ":" + (list.size() == 0 ? " []" : "") + "\n";
  for (int i = 0; i < list.size(); ++i)
    {
      out += indent + "  -\n";
      write_section(list.item(i), indent + "    ", out);
    }
}

void write_section(const ParameterSection &section, const std::string &indent, std::string &out)
{
  for (const auto &entry : section.entries())
    {
      if (indent.empty())
        out += "\n";
      if (const auto *parameter = std::get_if<Parameter>(&entry))
        {
          out += indent + "# " + one_line(parameter->meaning) + bracketed(parameter->unit) + ", " +
                 parameter->expected + "\n";
          out += indent + parameter->name + ": " + yaml(parameter->write()) + "\n";
        }
      else if (const auto *list = std::get_if<ParameterList>(&entry))
        {
          out += indent + "# " + one_line(list->meaning) + "\n";
          write_list(*list, indent, out);
        }
      else
        {
          const auto &inner = std::get<ParameterSection>(entry);
          out += indent + "# " + one_line(inner.meaning()) + "\n" + indent + inner.name() + ":\n";
          write_section(inner, indent + "  ", out);
        }
    }
}

void describe_value(const Parameter &parameter, const std::string &path, std::string &out)
{
  auto value = yaml(parameter.write());
  if (value.find("nan") != value.npos)
    value = "(to be given)";
  out += "  " + path + " = " + value + bracketed(parameter.unit) + "\n      " + parameter.meaning + "; " +
         parameter.expected + "\n";
}

/// Values first, so that what follows a section's title belongs to it.
void describe_section(const ParameterSection &section, const std::string &path, std::string &out)
{
  for (const auto &entry : section.entries())
    if (const auto *parameter = std::get_if<Parameter>(&entry))
      describe_value(*parameter, path + parameter->name, out);

  for (const auto &entry : section.entries())
    {
      const auto here = path + name(entry);
      if (const auto *list = std::get_if<ParameterList>(&entry))
        {
          out += "\n" + here + ", a list: " + list->meaning + "\n";
          describe_section(list->example(), here + ".0.", out);
        }
      else if (const auto *inner = std::get_if<ParameterSection>(&entry))
        {
          out += "\n" + here + ": " + inner->meaning() + "\n";
          describe_section(*inner, here + ".", out);
        }
    }
}

} // namespace

std::string parameter_reference(const ParameterSection &section)
{
  std::string out = "parameters, in the case file (YAML) or as --set section.key=value:\n";
  describe_section(section, "", out);
  return out;
}

Provenance provenance(const Environment &env)
{
  const auto &line  = env.command_line();
  Provenance  facts = {{"program", line.program}, {"case_file", line.case_file}};
  for (const auto &[name, number] : versions())
    facts.emplace_back(name, number);
  facts.emplace_back("ranks", std::to_string(env.n_ranks()));
  facts.emplace_back("threads", std::to_string(omp_get_max_threads()));
  return facts;
}

std::string used_yaml(const ParameterSection &section, const Provenance &facts)
{
  std::string out = "# All parameters as used; a case file that repeats the run.\n";
  write_section(section, "", out);
  if (!facts.empty())
    out += "\n# About the run that wrote this file; skipped by the reader.\nprovenance:\n";
  for (const auto &[name, value] : facts)
    out += "  " + name + ": " + yaml({value, {}}) + "\n";
  return out;
}

} // namespace sherd
