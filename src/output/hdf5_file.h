#pragma once

#include <string>
#include <vector>

#include <hdf5.h>

#include <sherd/base/exceptions.h>

/// A little order around the C interface of HDF5: identifiers that close themselves, failures as FileError.
namespace sherd::hdf5
{

inline void require(bool condition, const std::string &what)
{
  if (!condition)
    throw FileError("HDF5: cannot " + what + "; is the file intact and is there space left on the device?");
}

/// An identifier that closes itself.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string &what) : id_(id), close_(close) { require(id >= 0, what); }
  ~Handle() { close_(id_); }
  Handle(const Handle &)            = delete;
  Handle &operator=(const Handle &) = delete;

  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// While it lives, HDF5 reports failures by return values, not on the terminal.
class QuietErrors
{
public:
  QuietErrors()
  {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors &)            = delete;
  QuietErrors &operator=(const QuietErrors &) = delete;

private:
  H5E_auto2_t function_ = nullptr;
  void       *data_     = nullptr;
};

/// How much time compression may take.
enum class Compression
{
  quick = 1,
  usual = 4
};

inline Handle create_group(hid_t parent, const std::string &name)
{
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create group " + name};
}

inline Handle open_group(hid_t parent, const std::string &name)
{
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + name};
}

inline Handle open_data_set(hid_t parent, const std::string &name)
{
  return {H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "find " + name};
}

/// Writes an array, compressed; groups in its name are made. An empty shape: a single value.
/// @param values   of the type @p memory_type, row by row
void write_array(hid_t parent, const std::string &name, hid_t file_type, hid_t memory_type, const void *values,
                 const std::vector<hsize_t> &shape, Compression compression);

/// Shape of a data set; empty: a single value.
std::vector<hsize_t> shape_of(hid_t data_set);

/// All doubles of a data set, row by row.
std::vector<double> read_doubles(hid_t parent, const std::string &name);

} // namespace sherd::hdf5
