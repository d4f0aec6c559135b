#include <sherd/output/checkpoint.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/checkpoint.templates.h>

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

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template void write_checkpoint(const std::filesystem::path &, const Checkpoint<degree, spacedim> &);                 \
  template Checkpoint<degree, spacedim> read_checkpoint(const Environment &, const std::filesystem::path &);           \
  template std::optional<Checkpoint<degree, spacedim>> restart_checkpoint(const Environment &,                         \
                                                                          const Surface<degree, spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
