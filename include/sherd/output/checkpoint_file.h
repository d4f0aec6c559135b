#pragma once

#include <filesystem>
#include <string>

#include <sherd/output/stored_arrays.h>

/// The file of a checkpoint, without the meaning of its arrays. doc/output.md describes the layout.
namespace sherd
{

/// Version of the layout; others are refused.
inline constexpr int checkpoint_format = 3;

/// Writes @p arrays as HDF5, with a head of 512 bytes (an HDF5 user block) that holds the version of the layout, the
/// size of the file and a checksum of all that follows. The bytes are on the disk when it returns.
/// @throws FileError   if it cannot be written
void write_checkpoint_file(const std::filesystem::path &file, const StoredArrays &arrays);

/// The bytes of a checkpoint that is whole.
/// @throws FileError   no such file, no checkpoint, another version of the layout, truncated, or damaged; the message
///                     names another checkpoint beside it if there is one
std::string read_checkpoint_bytes(const std::filesystem::path &file);

/// The arrays in these bytes. @throws FileError   if HDF5 does not understand them
StoredArrays unpack_checkpoint(const std::string &bytes);

/// checkpoint.h5 for 0, checkpoint.N.h5 for the N-th older one.
std::filesystem::path checkpoint_name(int age);

} // namespace sherd
