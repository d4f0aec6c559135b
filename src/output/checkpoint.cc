#include <sherd/output/checkpoint.h>

namespace sherd
{

StoredArrays read_checkpoint_arrays(const Environment &env, const std::filesystem::path &file)
{
  std::string bytes;
  on_root(env.comm(), [&] { bytes = read_checkpoint_bytes(file); });
  bytes = broadcast(env.comm(), bytes);
  return collectively(env.comm(), [&] {
    try
      {
        return unpack_checkpoint(bytes);
      }
    catch (const FileError &error)
      {
        throw FileError("checkpoint " + file.string() + ": " + error.what());
      }
  });
}

} // namespace sherd
