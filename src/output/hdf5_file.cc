#include "hdf5_file.h"

#include <algorithm>

namespace sherd::hdf5
{

void write_array(hid_t parent, const std::string &name, hid_t file_type, hid_t memory_type, const void *values,
                 const std::vector<hsize_t> &shape, Compression compression)
{
  const int    rank = static_cast<int>(shape.size());
  const Handle space(rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, shape.data(), nullptr), H5Sclose,
                     "describe " + name);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "describe " + name);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe " + name);
  require(H5Pset_create_intermediate_group(links, 1) >= 0, "describe " + name);
  // Equal content, equal bytes, whenever it was written.
  require(H5Pset_obj_track_times(properties, false) >= 0, "describe " + name);
  if (rank > 0 && std::find(shape.begin(), shape.end(), 0) == shape.end())
    {
      auto chunk = shape;
      chunk[0]   = std::min<hsize_t>(shape[0], 1 << 14);
      require(H5Pset_chunk(properties, rank, chunk.data()) >= 0 && H5Pset_shuffle(properties) >= 0 &&
                  H5Pset_deflate(properties, static_cast<unsigned>(compression)) >= 0,
              "describe " + name);
    }
  const Handle set(H5Dcreate2(parent, name.c_str(), file_type, space, links, properties, H5P_DEFAULT), H5Dclose,
                   "create " + name);
  require(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, "write " + name);
}

std::vector<hsize_t> shape_of(hid_t data_set)
{
  const Handle         space(H5Dget_space(data_set), H5Sclose, "describe a data set");
  std::vector<hsize_t> shape(std::max(0, H5Sget_simple_extent_ndims(space)));
  require(shape.empty() || H5Sget_simple_extent_dims(space, shape.data(), nullptr) >= 0, "describe a data set");
  return shape;
}

std::vector<double> read_doubles(hid_t parent, const std::string &name)
{
  const Handle set  = open_data_set(parent, name);
  std::size_t  size = 1;
  for (const auto n : shape_of(set))
    size *= n;
  std::vector<double> values(size);
  require(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "read " + name);
  return values;
}

} // namespace sherd::hdf5
