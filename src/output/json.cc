#include <sherd/output/json.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sherd/base/exceptions.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/replace_file.h>

namespace sherd
{

std::string json(double value)
{
  return std::isfinite(value) ? exact(value) : "null";
}

std::string json(bool value)
{
  return value ? "true" : "false";
}

std::string json(std::string_view text)
{
  std::string result = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20)
      {
        char escaped[8];
        std::snprintf(escaped, sizeof(escaped), "\\u%04x", c);
        result += escaped;
      }
    else
      result += c;
  return result + "\"";
}

void JsonObject::insert(const std::string &name, std::string value)
{
  if (std::any_of(members_.begin(), members_.end(), [&](const auto &m) { return m.first == name; }))
    throw InvalidParameter("JSON object: member '" + name + "' is there already");
  members_.emplace_back(name, std::move(value));
}

std::string JsonObject::text() const
{
  if (members_.empty())
    return "{}";
  std::string result = "{";
  for (std::size_t k = 0; k < members_.size(); ++k)
    {
      result += (k > 0 ? ",\n  " : "\n  ") + json(members_[k].first) + ": ";
      // Lines of a nested value move in by one level.
      for (const char c : members_[k].second)
        result += c == '\n' ? std::string("\n  ") : std::string(1, c);
    }
  return result + "\n}";
}

void write_summary(const std::filesystem::path &directory, const JsonObject &summary)
{
  replace_file(directory / "summary.json", summary.text() + "\n");
}

} // namespace sherd
