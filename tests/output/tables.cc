#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <sherd/base/exceptions.h>
#include <sherd/output/history.h>
#include <sherd/output/json.h>
#include <sherd/output/replace_file.h>
#include <sherd/output/tips_table.h>

#include "prescribed_cracks.h"
#include "temporary_folder.h"

using namespace sherd;

TEST_CASE("exact: numbers read back as they were", "[output][csv]")
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> mantissa(-1., 1.), exponent(-300., 300.);

  for (int k = 0; k < 1000; ++k)
    {
      const double value = mantissa(random) * std::pow(10., exponent(random));
      CHECK(std::stod(exact(value)) == value);
    }
  CHECK(exact(0.1) == "0.1");
  CHECK(exact(std::nan("")) == "nan");
  CHECK(exact(-INFINITY) == "-inf");
}

TEST_CASE("CsvTable: every row is on disk at once", "[output][csv]")
{
  const test::TemporaryFolder folder;
  CsvTable                    table(folder.path() / "deep" / "t.csv", {"time", "name", "n"});

  table.append(CsvRow() << 0.5 << std::string("a") << 3);

  CHECK(test::content(folder.path() / "deep" / "t.csv") == "time,name,n\n0.5,a,3\n");
  CHECK_THROWS_AS(table.append(CsvRow() << 1.), DimensionMismatch);
  CHECK_THROWS_AS(CsvRow() << std::string("a,b"), InvalidParameter);
  // An edge of a geometry file may be called anything; its load has a column.
  CHECK_THROWS_AS(CsvTable(folder.path() / "t.csv", {"time", "traction left,upper"}), InvalidParameter);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "t.csv"));
  CHECK(column_name("traction left, \"upper\"\n") == "traction left   upper  ");
  CHECK(column_name("pressure 2") == "pressure 2");
}

TEST_CASE("CsvTable: a resumed table keeps the rows up to its time and no torn one", "[output][csv]")
{
  const test::TemporaryFolder folder;
  const auto                  file = folder.path() / "t.csv";
  replace_file(file, "step,time\n0,0\n1,0.1\n2,0.2\n3,0.3\n4,0.");

  auto table = CsvTable::resume(file, {"step", "time"}, 0.2);
  table.append(CsvRow() << 3 << 0.25);

  CHECK(test::content(file) == "step,time\n0,0\n1,0.1\n2,0.2\n3,0.25\n");
  CHECK_THROWS_AS(CsvTable::resume(file, {"time", "step"}, 0.2), FileError);
  CHECK_THROWS_AS(CsvTable::resume(file, {"step"}, 0.2), InvalidParameter);
  CHECK(test::content(file) == "step,time\n0,0\n1,0.1\n2,0.2\n3,0.25\n");
}

TEST_CASE("History: has its columns once and in order", "[output][csv]")
{
  const test::TemporaryFolder folder;
  HistoryRow                  row{};
  row.step = 7;
  row.time = 1. / 3.;
  row.dofs = 123456;
  row.wall = 2.5;

  row.dissipation = 0.25;
  row.fastest_tip = -1;
  {
    History history(folder.path());
    history.append(row);
  }
  row.step = 8;
  row.time = 0.5;
  History::resume(folder.path(), 0.4).append(row);

  CHECK(
      test::content(folder.path() / "history.csv") ==
      "step,time,dt,newton,linear,rejected,switched,elements,dofs,min_h,max_phi,elastic,kinetic,fracture,"
      "external_work,constraint,irreversible,balance,crack_length,tips,tip_speed,wall,active,passive,membrane,bending,"
      "support_work,load_work,dissipation,inertial_dissipation,refinement,closure,diffuse_length,fastest_tip,error\n"
      "7,0.3333333333333333,0,0,0,0,0,0,123456,0,0,0,0,0,0,0,0,0,0,0,0,2.5,0,0,0,0,0,0,0.25,0,0,0,0,-1,0\n"
      "8,0.5,0,0,0,0,0,0,123456,0,0,0,0,0,0,0,0,0,0,0,0,2.5,0,0,0,0,0,0,0.25,0,0,0,0,-1,0\n");
}

TEST_CASE("TipsTable: has a row for each active tip", "[output][csv][crack]")
{
  const test::TemporaryFolder folder;
  const double                l0    = 0.05;
  const auto                  plate = shapes::plate<2, 3>({1., 1.}, {80, 80});
  CrackTracker                tracker(plate, {l0, 2., l0 / 2.});
  tracker.update(plate, test::control_values(plate, test::Cracks{l0, {{{0.3, 0.5}, {0.7, 0.5}}}}), 0.25);

  TipsTable table(folder.path());
  table.append(3, 0.25, tracker);

  const auto        &tip = tracker.tree().tips().at(1);
  std::istringstream text(test::content(folder.path() / "tips.csv"));
  std::string        header, first, second, rest;
  std::getline(text, header);
  std::getline(text, first);
  std::getline(text, second);
  CHECK(header == "step,time,tip,parent,x,y,z,length,speed,speed_over_cR");
  CHECK(first.substr(0, 12) == "3,0.25,0,-1,");
  CHECK(second == "3,0.25,1,-1," + exact(tip.X[0]) + "," + exact(tip.X[1]) + ",0," + exact(tip.length) + ",0,0");
  CHECK_FALSE(std::getline(text, rest));
}

TEST_CASE("JsonObject: keeps order, nests, escapes, and has no NaN", "[output][json]")
{
  JsonObject object;
  object.add("name", "a \"b\"\n\\").add("steps", 12).add("nothing", std::nan("")).add("yes", true);
  object.add("list", std::vector<double>{1., 0.1, INFINITY}).add("empty", JsonObject());
  object.add("wall", JsonObject().add("assembly", 1.5).add("names", std::vector<std::string>{"u", "v"}));

  CHECK(object.text() == "{\n  \"name\": \"a \\\"b\\\"\\u000a\\\\\",\n  \"steps\": 12,\n  \"nothing\": null,\n"
                         "  \"yes\": true,\n  \"list\": [1, 0.1, null],\n  \"empty\": {},\n  \"wall\": {\n"
                         "    \"assembly\": 1.5,\n    \"names\": [\"u\", \"v\"]\n  }\n}");
  CHECK_THROWS_AS(object.add("steps", 1), InvalidParameter);
}

TEST_CASE("replace_file: keeps the old file where it cannot write", "[output]")
{
  const test::TemporaryFolder folder;
  replace_file(folder.path() / "a", "old");
  std::filesystem::create_directory(folder.path() / "a.part");

  CHECK_THROWS_AS(replace_file(folder.path() / "a", "new"), FileError);

  CHECK(test::content(folder.path() / "a") == "old");
  std::filesystem::remove(folder.path() / "a.part");
  write_summary(folder.path(), JsonObject().add("steps", 1));
  CHECK(test::content(folder.path() / "summary.json") == "{\n  \"steps\": 1\n}\n");
}
