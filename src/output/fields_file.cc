#include <sherd/output/fields_file.h>

#include <cstdio>
#include <functional>
#include <numeric>

#include <hdf5.h>

namespace sherd
{
namespace
{

constexpr int format_version = 1;

/// An HDF5 identifier that closes itself.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string &what) : id_(id), close_(close)
  {
    if (id < 0)
      throw FileError("fields.h5: cannot " + what + "; is the file intact and is there space left on the device?");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle &)            = delete;
  Handle &operator=(const Handle &) = delete;

  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, const std::string &what)
{
  if (status < 0)
    throw FileError("fields.h5: cannot " + what + "; is the file intact and is there space left on the device?");
}

/// HDF5 reports failures through exceptions here, not on the terminal.
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

Handle create_group(hid_t parent, const std::string &name)
{
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "create group " + name};
}

Handle open_group(hid_t parent, const std::string &name)
{
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "open group " + name};
}

/// Writes an array, compressed; the sizes but the first are given, the first follows.
void write_array(hid_t parent, const std::string &name, const std::vector<double> &values,
                 const std::vector<hsize_t> &row_shape = {})
{
  const hsize_t        row = std::accumulate(row_shape.begin(), row_shape.end(), hsize_t(1), std::multiplies<>());
  std::vector<hsize_t> shape{values.size() / row};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  const int    rank = static_cast<int>(shape.size());
  const Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose, "describe " + name);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe " + name);
  auto         chunk = shape;
  chunk[0]           = std::min<hsize_t>(std::max<hsize_t>(shape[0], 1), 1 << 14);
  require(H5Pset_chunk(properties, rank, chunk.data()), "describe " + name);
  require(H5Pset_shuffle(properties), "describe " + name);
  require(H5Pset_deflate(properties, 4), "describe " + name);
  const Handle set(H5Dcreate2(parent, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose, "create " + name);
  require(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write " + name);
}

template <class T>
hid_t native_type()
{
  return std::is_same_v<T, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
}

template <class T>
void write_attribute(hid_t object, const char *name, T value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, std::string("describe ") + name);
  const Handle attribute(H5Acreate2(object, name, native_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                         std::string("create ") + name);
  require(H5Awrite(attribute, native_type<T>(), &value), std::string("write ") + name);
}

template <class T>
T read_attribute(hid_t object, const char *name)
{
  T            value{};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, std::string("find ") + name);
  require(H5Aread(attribute, native_type<T>(), &value), std::string("read ") + name);
  return value;
}

std::string numbered(int number)
{
  char name[16];
  std::snprintf(name, sizeof(name), "%06d", number);
  return name;
}

int n_links(hid_t group)
{
  H5G_info_t info;
  require(H5Gget_info(group, &info), "count groups");
  return static_cast<int>(info.nlinks);
}

/// Sizes and a hash of the functions' knots: equal for equal meshes.
std::vector<std::size_t> fingerprint(const std::vector<PatchArrays> &patches)
{
  std::vector<std::size_t> result;
  for (const auto &patch : patches)
    {
      std::size_t hash = 0;
      for (const auto *values : {&patch.knots, &patch.weights, &patch.control_points})
        for (const double value : *values)
          hash = hash * 0x9e3779b97f4a7c15u + std::hash<double>()(value) + (hash >> 29);
      result.insert(result.end(), {patch.gamma.size(), patch.elements.size(), hash});
    }
  return result;
}

} // namespace

FieldsFile::FieldsFile(const std::filesystem::path &directory, int degree, int spacedim)
    : file_(directory / "fields.h5"), degree_(degree), spacedim_(spacedim)
{
  const QuietErrors quiet;
  std::error_code   error;
  std::filesystem::create_directories(directory, error);
  const Handle file(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                    "create " + file_.string());
  write_attribute(file, "format", format_version);
  write_attribute(file, "degree", degree);
  write_attribute(file, "spacedim", spacedim);
  create_group(file, "mesh");
  create_group(file, "frames");
}

FieldsFile FieldsFile::resume(const std::filesystem::path &directory, int degree, int spacedim, double time)
{
  const auto path = directory / "fields.h5";
  if (!std::filesystem::exists(path))
    return FieldsFile(directory, degree, spacedim);
  const QuietErrors quiet;
  const Handle      file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open " + path.string());
  const int found_degree = read_attribute<int>(file, "degree"), found_dim = read_attribute<int>(file, "spacedim");
  if (read_attribute<int>(file, "format") != format_version || found_degree != degree || found_dim != spacedim)
    throw FileError(path.string() + " is of degree " + std::to_string(found_degree) + " in " +
                    std::to_string(found_dim) + "d, expected degree " + std::to_string(degree) + " in " +
                    std::to_string(spacedim) + "d and format 1; move it away or write to another folder");
  const Handle frames = open_group(file, "frames"), meshes = open_group(file, "mesh");
  FieldsFile   result;
  result.file_     = path;
  result.degree_   = degree;
  result.spacedim_ = spacedim;
  result.n_meshes_ = n_links(meshes);
  const int n      = n_links(frames);
  for (int k = n - 1; k >= 0; --k)
    {
      double frame_time;
      {
        const Handle frame = open_group(frames, numbered(k));
        frame_time         = read_attribute<double>(frame, "time");
      }
      if (frame_time <= time)
        {
          result.n_frames_ = k + 1;
          break;
        }
      require(H5Ldelete(frames, numbered(k).c_str(), H5P_DEFAULT), "remove frame " + numbered(k));
    }
  return result;
}

void FieldsFile::check(int degree, int spacedim, std::size_t n_points, std::size_t n_position, std::size_t n_velocity,
                       std::size_t n_phase) const
{
  if (degree != degree_ || spacedim != spacedim_)
    throw DimensionMismatch("fields.h5 is of degree " + std::to_string(degree_) + " in " + std::to_string(spacedim_) +
                            "d, given a surface of degree " + std::to_string(degree) + " in " +
                            std::to_string(spacedim) + "d");
  if (n_position != n_points * spacedim || n_velocity != n_points * spacedim || n_phase != n_points)
    throw DimensionMismatch("fields.h5: the snapshot does not have a row for each of the " + std::to_string(n_points) +
                            " control points");
}

void FieldsFile::append(const std::vector<PatchArrays> &patches, double time, const std::vector<double> &position,
                        const std::vector<double> &velocity, const std::vector<double> &phase)
{
  const QuietErrors quiet;
  const Handle      file(H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open " + file_.string());
  const hsize_t     dim = spacedim_;
  if (auto mesh = fingerprint(patches); mesh != mesh_)
    {
      const Handle group = create_group(file, "mesh/" + numbered(n_meshes_));
      for (std::size_t p = 0; p < patches.size(); ++p)
        {
          const Handle patch = create_group(group, "patch_" + std::to_string(p));
          write_array(patch, "knots", patches[p].knots, {2, static_cast<hsize_t>(degree_) + 2});
          write_array(patch, "gamma", patches[p].gamma);
          write_array(patch, "weights", patches[p].weights);
          write_array(patch, "control_points", patches[p].control_points, {dim});
          write_array(patch, "elements", patches[p].elements, {4});
        }
      mesh_ = std::move(mesh);
      ++n_meshes_;
    }
  const Handle frame = create_group(file, "frames/" + numbered(n_frames_));
  write_attribute(frame, "time", time);
  write_attribute(frame, "mesh", n_meshes_ - 1);
  write_array(frame, "position", position, {dim});
  write_array(frame, "velocity", velocity, {dim});
  write_array(frame, "phase", phase);
  ++n_frames_;
}

} // namespace sherd
