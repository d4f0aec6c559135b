#include <sherd/output/fields_file.h>

#include <sherd/base/instantiate.h>
#include <sherd/output/fields_file.templates.h>

#include <cstdio>
#include <functional>
#include <numeric>

#include "hdf5_file.h"

namespace sherd
{
namespace
{

constexpr int format_version = 1;

using namespace hdf5;

/// Writes an array, compressed; the sizes but the first are given, the first follows.
void write_rows(hid_t parent, const std::string &name, const std::vector<double> &values,
                const std::vector<hsize_t> &row_shape = {})
{
  const hsize_t        row = std::accumulate(row_shape.begin(), row_shape.end(), hsize_t(1), std::multiplies<>());
  std::vector<hsize_t> shape{values.size() / row};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  write_array(parent, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data(), shape, Compression::usual);
}

/// Makes @p change in a copy of the file and puts that in its place in one step: a run that is killed meanwhile leaves
/// the file as it was.
template <class Change>
void change_in_one_step(const std::filesystem::path &file, const Change &change)
{
  auto part = file;
  part += ".part";
  std::error_code error;
  std::filesystem::copy_file(file, part, std::filesystem::copy_options::overwrite_existing, error);
  if (error)
    throw FileError("cannot copy " + file.string() + ": " + error.message());
  change(part);
  std::filesystem::rename(part, file, error);
  if (error)
    throw FileError("cannot replace " + file.string() + ": " + error.message());
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
  require(H5Awrite(attribute, native_type<T>(), &value) >= 0, std::string("write ") + name);
}

template <class T>
T read_attribute(hid_t object, const char *name)
{
  T            value{};
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, std::string("find ") + name);
  require(H5Aread(attribute, native_type<T>(), &value) >= 0, std::string("read ") + name);
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
  require(H5Gget_info(group, &info) >= 0, "count groups");
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

/// What fingerprint() needs of a mesh in the file.
std::vector<PatchArrays> read_mesh(hid_t meshes, int mesh)
{
  const Handle             group = open_group(meshes, numbered(mesh));
  std::vector<PatchArrays> patches(n_links(group));
  for (std::size_t p = 0; p < patches.size(); ++p)
    {
      const Handle patch        = open_group(group, "patch_" + std::to_string(p));
      patches[p].knots          = read_doubles(patch, "knots");
      patches[p].gamma          = read_doubles(patch, "gamma");
      patches[p].weights        = read_doubles(patch, "weights");
      patches[p].control_points = read_doubles(patch, "control_points");
      patches[p].elements       = read_doubles(patch, "elements");
    }
  return patches;
}

/// Removes the groups from number @p first on.
void remove_from(hid_t group, int first, const std::string &what)
{
  for (int k = n_links(group) - 1; k >= first; --k)
    require(H5Ldelete(group, numbered(k).c_str(), H5P_DEFAULT) >= 0, "remove " + what + " " + numbered(k));
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
  FieldsFile result;
  result.file_     = path;
  result.degree_   = degree;
  result.spacedim_ = spacedim;
  change_in_one_step(path, [&](const std::filesystem::path &part) {
    const QuietErrors quiet;
    const Handle      file(H5Fopen(part.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open " + path.string());
    const int found_degree = read_attribute<int>(file, "degree"), found_dim = read_attribute<int>(file, "spacedim");
    if (read_attribute<int>(file, "format") != format_version || found_degree != degree || found_dim != spacedim)
      throw FileError(path.string() + " is of degree " + std::to_string(found_degree) + " in " +
                      std::to_string(found_dim) + "d, expected degree " + std::to_string(degree) + " in " +
                      std::to_string(spacedim) + "d and format 1; move it away or write to another folder");
    const Handle frames = open_group(file, "frames"), meshes = open_group(file, "mesh");
    int          n_frames = n_links(frames), n_meshes = 0;
    while (n_frames > 0 && n_meshes == 0)
      {
        const Handle frame = open_group(frames, numbered(n_frames - 1));
        if (read_attribute<double>(frame, "time") <= time)
          n_meshes = read_attribute<int>(frame, "mesh") + 1;
        else
          --n_frames;
      }
    remove_from(frames, n_frames, "frame");
    remove_from(meshes, n_meshes, "mesh");
    if (n_meshes > 0)
      result.mesh_ = fingerprint(read_mesh(meshes, n_meshes - 1));
    result.n_frames_ = n_frames;
    result.n_meshes_ = n_meshes;
  });
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
  auto       mesh     = fingerprint(patches);
  const bool new_mesh = mesh != mesh_;
  const int  number   = n_meshes_ + new_mesh - 1;
  change_in_one_step(file_, [&](const std::filesystem::path &part) {
    const QuietErrors quiet;
    const Handle      file(H5Fopen(part.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open " + part.string());
    const hsize_t     dim = spacedim_;
    if (new_mesh)
      {
        const Handle group = create_group(file, "mesh/" + numbered(number));
        for (std::size_t p = 0; p < patches.size(); ++p)
          {
            const Handle patch = create_group(group, "patch_" + std::to_string(p));
            write_rows(patch, "knots", patches[p].knots, {2, static_cast<hsize_t>(degree_) + 2});
            write_rows(patch, "gamma", patches[p].gamma);
            write_rows(patch, "weights", patches[p].weights);
            write_rows(patch, "control_points", patches[p].control_points, {dim});
            write_rows(patch, "elements", patches[p].elements, {4});
            write_array(patch, "points", H5T_STD_I64LE, H5T_NATIVE_INT, patches[p].points.data(),
                        {patches[p].points.size()}, Compression::usual);
          }
      }
    const Handle frame = create_group(file, "frames/" + numbered(n_frames_));
    write_attribute(frame, "time", time);
    write_attribute(frame, "mesh", number);
    write_rows(frame, "position", position, {dim});
    write_rows(frame, "velocity", velocity, {dim});
    write_rows(frame, "phase", phase);
  });
  mesh_     = std::move(mesh);
  n_meshes_ = number + 1;
  ++n_frames_;
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template void FieldsFile::write(const Surface<degree, spacedim> &, const Snapshot<spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
