#include <catch2/catch.hpp>

#include <hdf5.h>

#include <sherd/output/fields_file.h>

#include "rational_surfaces.h"
#include "temporary_folder.h"

using namespace sherd;

namespace
{

std::vector<double> read(const std::filesystem::path &file, const std::string &name)
{
  const hid_t         f = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t         d = H5Dopen2(f, name.c_str(), H5P_DEFAULT);
  const hid_t         s = H5Dget_space(d);
  std::vector<double> values(H5Sget_simple_extent_npoints(s));
  H5Dread(d, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(s);
  H5Dclose(d);
  H5Fclose(f);
  return values;
}

int mesh_of(const std::filesystem::path &file, const std::string &frame)
{
  int         mesh = -1;
  const hid_t f    = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t a    = H5Aopen_by_name(f, frame.c_str(), "mesh", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(a, H5T_NATIVE_INT, &mesh);
  H5Aclose(a);
  H5Fclose(f);
  return mesh;
}

} // namespace

TEST_CASE("FieldsFile: holds the splines bit by bit, the mesh once as long as it stays", "[output][fields]")
{
  const test::TemporaryFolder folder;
  const auto                  file    = folder.path() / "fields.h5";
  const auto                  coarse  = test::quarter_cylinder();
  const auto                  refined = test::refined_quarter_cylinder();
  FieldsFile                  fields(folder.path(), 2, 3);

  fields.write(coarse, test::scaled(coarse, 1., 0.));
  fields.write(coarse, test::scaled(coarse, 1.1, 0.1));
  fields.write(refined, test::scaled(refined, 1.2, 0.2));

  CHECK(fields.n_frames() == 3);
  CHECK(mesh_of(file, "frames/000000") == 0);
  CHECK(mesh_of(file, "frames/000001") == 0);
  CHECK(mesh_of(file, "frames/000002") == 1);
  const auto snapshot = test::scaled(refined, 1.2, 0.2);
  const auto position = read(file, "frames/000002/position");
  REQUIRE(position.size() == static_cast<std::size_t>(snapshot.position.size()));
  CHECK(std::equal(position.begin(), position.end(), snapshot.position.data()));
  const auto knots = read(file, "mesh/000001/patch_0/knots");
  const int  n     = refined.n_control_points();
  REQUIRE(knots.size() == static_cast<std::size_t>(n) * 8);
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < 2; ++d)
      for (int k = 0; k < 4; ++k)
        CHECK(knots[8 * i + 4 * d + k] == refined.patch(0).basis.function(i).knots[d][k]);
  CHECK(read(file, "mesh/000001/patch_0/gamma").size() == static_cast<std::size_t>(n));
  CHECK(read(file, "mesh/000001/patch_0/elements").size() == static_cast<std::size_t>(refined.n_elements()) * 4);
}

TEST_CASE("FieldsFile: a resumed file drops later frames", "[output][fields]")
{
  const test::TemporaryFolder folder;
  const auto                  coarse = test::quarter_cylinder();
  {
    FieldsFile fields(folder.path(), 2, 3);
    for (double time : {0., 0.1, 0.2, 0.3})
      fields.write(coarse, test::scaled(coarse, 1., time));
  }

  auto fields = FieldsFile::resume(folder.path(), 2, 3, 0.15);
  CHECK(fields.n_frames() == 2);
  fields.write(coarse, test::scaled(coarse, 2., 0.16));

  CHECK(read(folder.path() / "fields.h5", "frames/000002/position")[0] == 2. * coarse.control_points()(0, 0));
  CHECK_THROWS_AS(FieldsFile::resume(folder.path(), 3, 3, 0.15), FileError);
  CHECK_THROWS_AS(FieldsFile(folder.path(), 3, 3).write(coarse, test::scaled(coarse, 1., 0.)), DimensionMismatch);
}

TEST_CASE("FieldsFile: a resumed file drops later meshes and does not repeat the last", "[output][fields]")
{
  const test::TemporaryFolder folder;
  const auto                  file   = folder.path() / "fields.h5";
  const auto                  coarse = test::quarter_cylinder(), refined = test::refined_quarter_cylinder();
  {
    FieldsFile fields(folder.path(), 2, 3);
    fields.write(coarse, test::scaled(coarse, 1., 0.));
    fields.write(refined, test::scaled(refined, 1., 0.1));
  }
  const auto whole  = test::content(file);
  auto       fields = FieldsFile::resume(folder.path(), 2, 3, 0.05);
  fields.write(coarse, test::scaled(coarse, 1., 0.07));
  CHECK(mesh_of(file, "frames/000001") == 0);
  fields.write(refined, test::scaled(refined, 1., 0.1));
  CHECK(mesh_of(file, "frames/000002") == 1);
  CHECK(read(file, "mesh/000001/patch_0/gamma").size() == static_cast<std::size_t>(refined.n_control_points()));

  // A run that was killed while it wrote leaves a half-made copy, and the file as it was.
  std::ofstream(folder.path() / "fields.h5.part") << whole.substr(0, whole.size() / 2);
  CHECK(FieldsFile::resume(folder.path(), 2, 3, 1.).n_frames() == 3);
}

TEST_CASE("FieldsFile: a broken file is an error with a message", "[output][fields]")
{
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "fields.h5") << "not HDF5";

  CHECK_THROWS_AS(FieldsFile::resume(folder.path(), 2, 3, 0.), FileError);
}
