#include <sherd/base/text_file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <sherd/base/collective.h>
#include <sherd/base/exceptions.h>

namespace sherd
{
namespace
{

std::string last_system_error()
{
  return errno != 0 ? std::strerror(errno) : "unknown reason";
}

} // namespace

std::string read_text(const Environment &env, const std::filesystem::path &file)
{
  std::ostringstream text;
  on_root(env.comm(), [&] {
    if (std::filesystem::is_directory(file))
      throw FileError("cannot read " + file.string() + ": it is a directory");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (in.peek() != std::ifstream::traits_type::eof())
      text << in.rdbuf();
    if (!in.is_open() || in.bad())
      throw FileError("cannot read " + file.string() + ": " + last_system_error());
  });
  return broadcast(env.comm(), text.str());
}

void write_text(const Environment &env, const std::filesystem::path &file, const std::string &text)
{
  on_root(env.comm(), [&] {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out << text << std::flush;
    if (!out)
      throw FileError("cannot write " + file.string() + ": " + last_system_error());
  });
}

} // namespace sherd
