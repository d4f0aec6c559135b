#include <sherd/output/restart.h>

#include <algorithm>

#include <sherd/output/checkpoint.h>

namespace sherd
{
namespace
{

std::string show(const ParameterText &text)
{
  if (!text.is_list)
    return text.word;
  std::string items;
  for (const auto &item : text.items)
    items += (items.empty() ? "" : ", ") + show(item);
  return "[" + items + "]";
}

/// All values below @p section by path.
void collect(const ParameterSection &section, const std::string &path, std::map<std::string, std::string> &values)
{
  for (const auto &entry : section.entries())
    {
      const auto here = path + name(entry);
      if (const auto *parameter = std::get_if<Parameter>(&entry))
        values[here] = show(parameter->write());
      else if (const auto *inner = std::get_if<ParameterSection>(&entry))
        collect(*inner, here + ".", values);
      else
        {
          const auto &list = std::get<ParameterList>(entry);
          for (int i = 0; i < list.size(); ++i)
            collect(list.item(i), here + "." + std::to_string(i) + ".", values);
        }
    }
}

bool is_below(const std::string &path, const std::string &section)
{
  return path == section || path.starts_with(section + ".");
}

} // namespace

std::string read_checkpoint_parameters(const Environment &env, const std::filesystem::path &file)
{
  const auto arrays = read_checkpoint_arrays(env, file);
  return collectively(env.comm(), [&] {
    std::string text;
    ArrayReader archive(arrays);
    archive("parameters", text);
    return text;
  });
}

void refuse_changes(const ParameterSection &stored, const ParameterSection &now, const std::vector<std::string> &fixed,
                    const std::string &file)
{
  std::map<std::string, std::string> before, after;
  collect(stored, "", before);
  collect(now, "", after);
  for (const auto *values : {&before, &after})
    for (const auto &[path, value] : *values)
      if (std::any_of(fixed.begin(), fixed.end(), [&](const auto &section) { return is_below(path, section); }) &&
          (!before.contains(path) || !after.contains(path) || before[path] != after[path]))
        throw InvalidParameter(path + " = " + (after.contains(path) ? after[path] : "(nothing)") +
                               ", but the checkpoint " + file + " was written with " +
                               (before.contains(path) ? before[path] : "(nothing)") +
                               "; a restart cannot change body, mesh or model: leave it out, or start a new run");
}

} // namespace sherd
