#include <sherd/output/replace_file.h>

#include <fstream>

#include <sherd/base/exceptions.h>

namespace sherd
{

void replace_file(const std::filesystem::path &file, std::string_view content)
{
  std::error_code error;
  if (file.has_parent_path())
    std::filesystem::create_directories(file.parent_path(), error);
  auto part = file;
  part += ".part";
  {
    std::ofstream stream(part, std::ios::binary | std::ios::trunc);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.flush();
    if (!stream)
      {
        std::filesystem::remove(part, error);
        throw FileError("cannot write " + part.string() +
                        "; is the folder writable and is there space left on the device?");
      }
  }
  std::filesystem::rename(part, file, error);
  if (error)
    throw FileError("cannot replace " + file.string() + ": " + error.message());
}

} // namespace sherd
