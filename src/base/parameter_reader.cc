#include <algorithm>
#include <set>

#include <yaml-cpp/yaml.h>

#include <sherd/base/nearest_name.h>
#include <sherd/base/parameters.h>

namespace sherd
{
namespace
{

constexpr std::string_view provenance_key = "provenance";

std::string join(const std::string &path, const std::string &name)
{
  return path.empty() ? name : path + "." + name;
}

/// The value as a user would write it.
std::string show(const ParameterText &text)
{
  if (!text.is_list)
    return text.word.empty() ? "\"\"" : text.word;
  std::string items;
  for (const auto &item : text.items)
    items += (items.empty() ? "" : ", ") + show(item);
  return "[" + items + "]";
}

/// Paths of everything below @p section; list items stand under 0.
void collect_paths(const ParameterSection &section, const std::string &path, std::vector<std::string> &paths)
{
  for (const auto &entry : section.entries())
    {
      const auto here = join(path, name(entry));
      paths.push_back(here);
      if (const auto *list = std::get_if<ParameterList>(&entry))
        collect_paths(list->example(), join(here, "0"), paths);
      else if (const auto *inner = std::get_if<ParameterSection>(&entry))
        collect_paths(*inner, here, paths);
    }
}

const ParameterSection::Entry *find(const ParameterSection &section, const std::string &name)
{
  for (const auto &entry : section.entries())
    if (sherd::name(entry) == name)
      return &entry;
  return nullptr;
}

/// Reads one source of values, the case file or one override.
class Reader
{
public:
  /// @param file  name of the case file, empty for an override
  Reader(const ParameterSection &root, std::string file, std::string override_text = "")
      : root_(root), file_(std::move(file)), override_(std::move(override_text))
  {
  }

  void read_file(const YAML::Node &document) { read_section(root_, "", document); }

  void read_override(const std::string &path, const std::string &value)
  {
    const YAML::Node node = override_node(value);
    descend(root_, "", path, [&](const ParameterSection::Entry &entry) { read_entry(entry, path, node); });
  }

private:
  /// Only what opens a list, a section or a quote needs the rules of YAML; formulas may hold ": " or "#".
  YAML::Node override_node(const std::string &value) const
  {
    if (value.empty() || std::string_view("[{\"'").find(value[0]) == std::string_view::npos)
      return YAML::Node(value);
    try
      {
        return YAML::Load(value);
      }
    catch (const YAML::Exception &e)
      {
        throw InvalidParameter(override_ + " is not understood: " + e.msg);
      }
  }

  template <class Action>
  void descend(const ParameterSection &section, const std::string &done, const std::string &rest, const Action &action)
  {
    const auto  dot   = rest.find('.');
    const auto  key   = rest.substr(0, dot);
    const auto *entry = find(section, key);
    if (!entry)
      fail_unknown(section, done, key, override_);
    if (dot == rest.npos)
      return action(*entry);

    const auto path  = join(done, key);
    const auto below = rest.substr(dot + 1);
    if (const auto *inner = std::get_if<ParameterSection>(entry))
      return descend(*inner, path, below, action);
    if (const auto *list = std::get_if<ParameterList>(entry))
      {
        const auto inner_dot = below.find('.');
        const auto index     = parse_int(below.substr(0, inner_dot));
        if (!index || *index < 0 || *index >= list->size() || inner_dot == below.npos)
          throw InvalidParameter(override_ + ", expected " + path + ".INDEX.KEY with INDEX from 0 to less than " +
                                 std::to_string(list->size()) + ", the number of items in the list");
        return descend(list->item(*index), join(path, std::to_string(*index)), below.substr(inner_dot + 1), action);
      }
    throw InvalidParameter(override_ + ": " + path + " is a value, not a section");
  }

  void read_section(const ParameterSection &section, const std::string &path, const YAML::Node &node)
  {
    if (!node.IsDefined() || node.IsNull())
      return;
    if (!node.IsMap())
      throw InvalidParameter((path.empty() ? "the document" : path) + " is not a section (" + where(node) +
                             "), expected lines \"key: value\"");
    std::set<std::string> seen;
    for (const auto &item : node)
      {
        if (!item.first.IsScalar())
          throw InvalidParameter("a key of section \"" + path + "\" is no name (" + where(item.first) + ")");
        const auto key = item.first.Scalar();
        if (!seen.insert(key).second)
          throw InvalidParameter(join(path, key) + " is given twice (" + where(item.first) + ")");
        if (path.empty() && key == provenance_key)
          continue;
        const auto *entry = find(section, key);
        if (!entry)
          fail_unknown(section, path, key, where(item.first));
        read_entry(*entry, join(path, key), item.second);
      }
  }

  void read_entry(const ParameterSection::Entry &entry, const std::string &path, const YAML::Node &node)
  {
    if (const auto *parameter = std::get_if<Parameter>(&entry))
      read_value(*parameter, path, node);
    else if (const auto *list = std::get_if<ParameterList>(&entry))
      read_list(*list, path, node);
    else
      read_section(std::get<ParameterSection>(entry), path, node);
  }

  void read_list(const ParameterList &list, const std::string &path, const YAML::Node &node)
  {
    if (!node.IsSequence())
      throw InvalidParameter(path + " is not a list (" + where(node) + "), expected \"- key: value\" for every item");
    list.resize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i)
      read_section(list.item(static_cast<int>(i)), join(path, std::to_string(i)), node[i]);
  }

  void read_value(const Parameter &parameter, const std::string &path, const YAML::Node &node)
  {
    if (node.IsNull() || node.IsMap())
      throw InvalidParameter(path + (node.IsMap() ? " is given as a section" : " has no value") + ", expected " +
                             parameter.expected + " (" + where(node) + ")");
    const auto text    = convert(node);
    const auto earlier = show(parameter.write());
    try
      {
        parameter.read(text);
      }
    catch (const InvalidParameter &e)
      {
        const auto unit = parameter.unit.empty() ? "" : " [" + parameter.unit + "]";
        const auto hint = earlier.size() > 40 || earlier.find("nan") != earlier.npos ? "" : "; try " + earlier;
        throw InvalidParameter(path + " = " + show(text) + unit + ", " + e.what() + " (" + where(node) + ")" + hint);
      }
  }

  ParameterText convert(const YAML::Node &node) const
  {
    if (node.IsScalar())
      return {node.Scalar(), {}};
    if (!node.IsSequence())
      throw InvalidParameter("a list holds something that is no value (" + where(node) + ")");
    ParameterText list{"", {}, true};
    for (const auto &item : node)
      list.items.push_back(convert(item));
    return list;
  }

  [[noreturn]] void fail_unknown(const ParameterSection &section, const std::string &path, const std::string &key,
                                 const std::string &location) const
  {
    std::vector<std::string> siblings, all;
    for (const auto &entry : section.entries())
      siblings.push_back(name(entry));
    collect_paths(root_, "", all);

    auto nearest = nearest_name(key, siblings);
    // A key that is right but in the wrong section.
    const auto elsewhere = std::find_if(all.begin(), all.end(),
                                        [&](const auto &known) { return known.ends_with("." + key) || known == key; });
    if (elsewhere != all.end() && edit_distance(key, nearest) > 2)
      nearest = *elsewhere;
    else
      nearest = join(path, nearest);
    throw InvalidParameter("unknown parameter " + join(path, key) + " (" + location + "), the nearest known one is " +
                           nearest + "; see --help");
  }

  std::string where(const YAML::Node &node) const
  {
    if (!override_.empty())
      return override_;
    const auto mark = node.Mark();
    if (mark.is_null())
      return file_;
    return file_ + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
  }

  const ParameterSection &root_;
  std::string             file_, override_;
};

/// Finds what has to be given and was not: its default does not satisfy its own declaration.
void check_complete(const ParameterSection &section, const std::string &path)
{
  for (const auto &entry : section.entries())
    {
      const auto here = join(path, name(entry));
      if (const auto *inner = std::get_if<ParameterSection>(&entry))
        check_complete(*inner, here);
      else if (const auto *list = std::get_if<ParameterList>(&entry))
        for (int i = 0; i < list->size(); ++i)
          check_complete(list->item(i), join(here, std::to_string(i)));
      else
        {
          const auto &parameter = std::get<Parameter>(entry);
          try
            {
              parameter.read(parameter.write());
            }
          catch (const InvalidParameter &e)
            {
              const auto unit = parameter.unit.empty() ? "" : " [" + parameter.unit + "]";
              throw InvalidParameter(here + unit + " is missing, " + e.what() +
                                     "; give it in the case file or by --set " + here + "=VALUE (" + parameter.meaning +
                                     ")");
            }
        }
    }
}

YAML::Node parse(const std::string &text, const std::string &source)
{
  try
    {
      const auto documents = YAML::LoadAll(text);
      if (documents.size() > 1)
        throw FileError(source + " holds " + std::to_string(documents.size()) + " YAML documents, expected one");
      return documents.empty() ? YAML::Node() : documents[0];
    }
  catch (const YAML::Exception &e)
    {
      throw FileError(source + ":" + std::to_string(e.mark.line + 1) + ":" + std::to_string(e.mark.column + 1) +
                      ": not YAML: " + e.msg + "; texts with special characters need quotes");
    }
}

} // namespace

void read_parameters(ParameterSection &section, const std::string &text, const std::string &source,
                     const std::vector<std::pair<std::string, std::string>> &overrides)
{
  Reader(section, source).read_file(parse(text, source));
  for (const auto &[path, value] : overrides)
    Reader(section, "", "--set " + path + "=" + value).read_override(path, value);
  check_complete(section, "");
}

std::string read_case_file(const Environment &env)
{
  const auto &file = env.command_line().case_file;
  return file.empty() ? "" : read_text(env, file);
}

} // namespace sherd
