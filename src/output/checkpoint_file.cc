#include <sherd/output/checkpoint_file.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include "hdf5_file.h"

namespace sherd
{
namespace
{

using namespace hdf5;

constexpr std::size_t head_size = 512;
constexpr const char *head_form = "sherd checkpoint, layout %d\nbytes %020llu\ncrc32 %08lx\n";

unsigned long checksum(const char *data, std::size_t size)
{
  return crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef *>(data), size);
}

/// How to access an HDF5 file in memory that is never written by HDF5 itself.
struct MemoryDriver
{
  Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare a file in memory"};

  MemoryDriver() { require(H5Pset_fapl_core(access, 1 << 20, false) >= 0, "prepare a file in memory"); }
};

void write(hid_t file, const std::string &name, const StoredArray &array)
{
  const std::vector<hsize_t> shape(array.shape.begin(), array.shape.end());
  if (const auto *numbers = std::get_if<std::vector<double>>(&array.values))
    write_array(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, numbers->data(), shape, Compression::quick);
  else if (const auto *integers = std::get_if<std::vector<std::int64_t>>(&array.values))
    write_array(file, name, H5T_STD_I64LE, H5T_NATIVE_INT64, integers->data(), shape, Compression::quick);
  else
    {
      const auto  &text = std::get<std::string>(array.values);
      const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe " + name);
      require(H5Tset_size(type, text.size() + 1) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0, "describe " + name);
      write_array(file, name, type, type, text.c_str(), {}, Compression::quick);
    }
}

StoredArray read(hid_t file, const std::string &name)
{
  const Handle set = open_data_set(file, name);
  const Handle type(H5Dget_type(set), H5Tclose, "describe " + name);
  const auto   shape = shape_of(set);
  StoredArray  array{{shape.begin(), shape.end()}, {}};
  std::size_t  size = 1;
  for (const auto n : shape)
    size *= n;
  const auto fill = [&](hid_t memory_type, void *values) {
    require(H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, "read " + name);
  };
  switch (H5Tget_class(type))
    {
    case H5T_FLOAT:
      fill(H5T_NATIVE_DOUBLE, array.values.emplace<std::vector<double>>(size).data());
      break;
    case H5T_INTEGER:
      fill(H5T_NATIVE_INT64, array.values.emplace<std::vector<std::int64_t>>(size).data());
      break;
    default:
      {
        std::string text(H5Tget_size(type), '\0');
        fill(type, text.data());
        text.resize(std::strlen(text.c_str()));
        array.values = std::move(text);
      }
    }
  return array;
}

herr_t note_data_set(hid_t, const char *name, const H5O_info_t *info, void *names)
{
  if (info->type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string> *>(names)->push_back(name);
  return 0;
}

void write_durably(const std::filesystem::path &file, const std::array<std::string_view, 2> &parts)
{
  const int  descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const auto fail       = [&] {
    const std::string reason = std::strerror(errno);
    if (descriptor >= 0)
      {
        std::error_code error;
        close(descriptor);
        std::filesystem::remove(file, error);
      }
    throw FileError("cannot write " + file.string() + ": " + reason + "; the checkpoints before it are still there");
  };
  if (descriptor < 0)
    fail();
  for (auto rest : parts)
    while (!rest.empty())
      {
        const auto written = ::write(descriptor, rest.data(), rest.size());
        if (written < 0 && errno != EINTR)
          fail();
        rest.remove_prefix(std::max<ssize_t>(written, 0));
      }
  if (fsync(descriptor) != 0)
    fail();
  close(descriptor);
}

/// What is wrong with the bytes of a checkpoint; empty if nothing is.
std::string fault(const std::string &bytes)
{
  int                layout = 0;
  unsigned long long size   = 0;
  unsigned long      crc    = 0;
  const std::string  head   = bytes.substr(0, head_size);
  const int          found  = std::sscanf(head.c_str(), head_form, &layout, &size, &crc);
  if (found < 1)
    return "this is no checkpoint";
  if (layout != checkpoint_format)
    return "its layout has the version " + std::to_string(layout) + ", this program reads version " +
           std::to_string(checkpoint_format) + "; go on with the program that wrote it";
  if (found < 3 || bytes.size() < head_size || bytes.size() != size)
    return "it is truncated, " + std::to_string(bytes.size()) + " bytes of " +
           (found < 2 ? std::string("an unknown number") : std::to_string(size));
  if (checksum(bytes.data() + head_size, bytes.size() - head_size) != crc)
    return "it is damaged, its checksum is not that of its content";
  return {};
}

/// All bytes of a file; nothing if it cannot be read.
std::optional<std::string> load(const std::filesystem::path &file)
{
  std::error_code error;
  std::ifstream   stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file, error))
    return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// Another checkpoint of the same folder that is whole, the newest one, in words.
std::string alternative(const std::filesystem::path &file)
{
  for (int age = 0; age < 100; ++age)
    {
      const auto other = file.parent_path() / checkpoint_name(age);
      if (const auto bytes = load(other); other.filename() != file.filename() && bytes && fault(*bytes).empty())
        return "; another one is whole: --restart " + other.string();
    }
  return {};
}

} // namespace

std::filesystem::path checkpoint_name(int age)
{
  return age == 0 ? "checkpoint.h5" : "checkpoint." + std::to_string(age) + ".h5";
}

void write_checkpoint_file(const std::filesystem::path &file, const StoredArrays &arrays)
{
  const QuietErrors quiet;
  std::string       image;
  {
    const MemoryDriver driver;
    const Handle       creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "prepare a file in memory");
    require(H5Pset_userblock(creation, head_size) >= 0, "prepare a file in memory");
    const Handle memory(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, driver.access), H5Fclose,
                        "make a file in memory");
    for (const auto &[name, array] : arrays.all())
      write(memory, name, array);
    require(H5Fflush(memory, H5F_SCOPE_GLOBAL) >= 0, "finish a file in memory");
    const auto size = H5Fget_file_image(memory, nullptr, 0);
    require(size > 0, "finish a file in memory");
    image.resize(size);
    require(H5Fget_file_image(memory, image.data(), image.size()) == size, "finish a file in memory");
  }
  // HDF5 may hand out the image with or without the space of the head.
  const std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  std::string_view       content(image);
  if (!content.starts_with(signature))
    content.remove_prefix(head_size);
  require(content.starts_with(signature), "finish a file in memory");

  std::string head(head_size, '\0');
  std::snprintf(head.data(), head.size(), head_form, checkpoint_format,
                static_cast<unsigned long long>(head_size + content.size()), checksum(content.data(), content.size()));
  write_durably(file, {head, content});
}

std::string read_checkpoint_bytes(const std::filesystem::path &file)
{
  auto              bytes  = load(file);
  const std::string reason = bytes                           ? fault(*bytes)
                             : std::filesystem::exists(file) ? "it cannot be read"
                                                             : "there is no such file";
  if (!reason.empty())
    throw FileError("checkpoint " + file.string() + ": " + reason + alternative(file));
  return *std::move(bytes);
}

StoredArrays unpack_checkpoint(const std::string &bytes)
{
  const QuietErrors  quiet;
  const MemoryDriver driver;
  std::string        image = bytes;
  require(H5Pset_file_image(driver.access, image.data(), image.size()) >= 0, "read a checkpoint");
  const Handle             file(H5Fopen("checkpoint", H5F_ACC_RDONLY, driver.access), H5Fclose, "read a checkpoint");
  std::vector<std::string> names;
  require(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, note_data_set, &names, H5O_INFO_BASIC) >= 0,
          "list the arrays of a checkpoint");
  StoredArrays arrays;
  for (const auto &name : names)
    arrays.add(name, read(file, name));
  return arrays;
}

} // namespace sherd
