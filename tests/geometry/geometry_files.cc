// label: unit
// ranks: 1 2
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include <catch2/catch.hpp>

#include <geometry/patch_samples.h>
#include <sherd/base/collective.h>
#include <sherd/geometry/gismo_xml.h>
#include <sherd/geometry/gotools.h>
#include <sherd/geometry/shapes.h>

using namespace sherd;

namespace
{

/// @p text with its first @p from replaced.
std::string with(std::string text, const std::string &from, const std::string &to)
{
  const auto at = text.find(from);
  REQUIRE(at != text.npos);
  return text.replace(at, from.size(), to);
}

/// What a reader says about a text.
template <class Parse>
std::string complaint(const Parse &parse, const std::string &text)
{
  try
    {
      parse(text);
    }
  catch (const FileError &error)
    {
      return error.what();
    }
  return "nothing";
}

std::string about_xml(const std::string &text)
{
  return complaint([](const std::string &t) { parse_gismo_xml<2, 3>(t, "a.xml"); }, text);
}

std::string about_g2(const std::string &text)
{
  return complaint([](const std::string &t) { parse_g2<2, 3>(t, "a.g2"); }, text);
}

/// Surfaces with all that files hold: rational and polynomial patches, interfaces in any orientation, seams, names.
template <class Function>
void for_all_samples(const Function &f)
{
  f(shapes::sphere<2>(1. / 3., 3));
  f(shapes::sphere<4>(1.7, 2));
  f(shapes::closed_torus<3>(2., .7, {3, 4}, {2, 1}));
  f(shapes::closed_cylinder<2>(1., 1., 1, {2, 5}, shapes::Fit::smooth));
  f(split_patches(test::distorted(shapes::plate<2, 2>({.3, 7.}, {4, 4}), .1), {2, 2}));
  f(shapes::polygon<3, 2>(.1, 5, 2));
  const auto plate = shapes::plate<2, 3>({1., 1.}, {1, 1}).patch(0);
  f(Surface<2, 3>({plate}, {{"<a & \"b\">", {{0, Side::u_min}}},
                            {"boundary", {{0, Side::v_max}, {0, Side::v_min}}},
                            {"c", {{0, Side::u_min}, {0, Side::u_max}}}}));
}

/// Two patches with one interface, as another program might write them: ids from 7, fractions, blanks.
const std::string two_patches = R"(<?xml version="1.0"?>
<!-- made by hand -->
<xml>
  <Function type="FunctionExpr" id="3" dim="2">sin(x)</Function>
  <Geometry type="TensorBSpline2" id="7">
    <Basis type="TensorBSplineBasis2">
      <Basis type="BSplineBasis" index="0"><KnotVector degree="2">0 0 0 1 1 1</KnotVector></Basis>
      <Basis type="BSplineBasis" index="1"><KnotVector degree="2">0 0 0 .5 1 1 1</KnotVector></Basis>
    </Basis>
    <coefs geoDim="2">
      0 0  1/2 0  1 0
      0 1/4  1/2 1/4  1 1/4
      0 3/4  1/2 3/4  1 3/4
      0 1  1/2 1  1 1
    </coefs>
  </Geometry>
  <Geometry type="TensorNurbs2" id="9">
    <Basis type="TensorNurbsBasis2">
      <Basis type="TensorBSplineBasis2">
        <Basis type="BSplineBasis" index="1"><KnotVector degree="2">2 2 2 3 3 3</KnotVector></Basis>
        <Basis type="BSplineBasis" index="0"><KnotVector degree="2">0 0 0 1 2 2 2</KnotVector></Basis>
      </Basis>
      <weights>1 1 1 1  2 2 2 2  1 1 1 1</weights>
    </Basis>
    <coefs geoDim="2">
      1 1  1 3/4  1 1/4  1 0
      2 1  2 3/4  2 1/4  2 0
      3 1  3 3/4  3 1/4  3 0
    </coefs>
  </Geometry>
  <MultiPatch parDim="2" id="0">
    <patches type="id_index">7 9</patches>
    <interfaces>7 2 9 3 1 0 1 0</interfaces>
    <boundary name="floor">7 3
9 2</boundary>
    <boundary>9 4</boundary>
  </MultiPatch>
</xml>
)";

const std::string one_surface = R"(200 1 0 0
3 1
3 3
0 0 0 1 1 1
3 3
0 0 0 2 2 2
0 0 0 1
1 0 0 1
2 0 0 1
0 .5 1 .5
.5 .5 1 .5
1 .5 1 .5
0 2 2 1
1 2 2 1
2 2 2 1
)";

} // namespace

TEST_CASE("What is written as G+Smo XML reads back bit by bit")
{
  for_all_samples([](const auto &surface) {
    using Type       = std::decay_t<decltype(surface)>;
    const auto again = [&]<int degree, int spacedim>(const Surface<degree, spacedim> &) {
      return parse_gismo_xml<degree, spacedim>(to_gismo_xml(surface));
    };
    const Type read = again(surface);
    CHECK(test::identical(surface, read));
    CHECK(to_gismo_xml(read) == to_gismo_xml(surface));
  });
}

TEST_CASE("What is written as .g2 reads back bit by bit, rational products too")
{
  for_all_samples([](const auto &surface) {
    const auto again = [&]<int degree, int spacedim>(const Surface<degree, spacedim> &) {
      return parse_g2<degree, spacedim>(to_g2(surface));
    };
    const auto read = again(surface);
    REQUIRE(read.n_patches() == surface.n_patches());
    CHECK(read.interfaces().size() == surface.interfaces().size());
    CHECK(read.n_control_points() == surface.n_control_points());
    for (int p = 0; p < surface.n_patches(); ++p)
      {
        CHECK(read.patch(p).basis.initial_knots() == surface.patch(p).basis.initial_knots());
        CHECK(read.patch(p).control_points == surface.patch(p).control_points);
        CHECK(read.patch(p).weights == surface.patch(p).weights);
      }
    CHECK(to_g2(read) == to_g2(surface));
  });
}

TEST_CASE("A file by hand: ids, fractions, comments, other elements, reversed interface, names")
{
  const auto surface = parse_gismo_xml<2, 2>(two_patches);
  REQUIRE(surface.n_patches() == 2);
  CHECK(surface.patch(0).control_points(1, 0) == .5);
  CHECK(surface.patch(0).basis.initial_knots()[1] == std::vector{0., 0., 0., .5, 1., 1., 1.});
  CHECK(surface.patch(1).weights[4] == 2.);
  REQUIRE(surface.interfaces().size() == 1);
  CHECK(surface.interfaces()[0].reversed);
  CHECK(surface.n_control_points() == 12 + 8);
  CHECK(test::largest_gap(surface) < 1e-15);
  REQUIRE(surface.edge("floor").size() == 2);
  CHECK(surface.edge("floor")[1].patch == 1);
  CHECK(surface.edge("floor")[1].side == Side::u_max);
  CHECK(surface.edge("boundary").size() == 4); // 7: u_min, v_max; 9: u_min, v_max

  // The same in space lies in the plane z = 0.
  const auto shell = parse_gismo_xml<2, 3>(two_patches);
  CHECK(shell.control_points().col(2).norm() == 0.);
  CHECK(shell.control_points().leftCols(2) == surface.control_points());

  // Without a word about interfaces they are found; without a MultiPatch all geometries are taken.
  const auto begin = two_patches.find("  <MultiPatch"), end = two_patches.find("</xml>");
  const auto found = parse_gismo_xml<2, 2>(two_patches.substr(0, begin) + two_patches.substr(end));
  CHECK(found.interfaces().size() == 1);
  CHECK(found.edge("boundary").size() == 6);

  // Only boundary sides listed: nothing is joined.
  const auto slit = parse_gismo_xml<2, 2>(with(two_patches, "<interfaces>7 2 9 3 1 0 1 0</interfaces>", ""));
  CHECK(slit.interfaces().empty());

  // Five numbers for an interface, as in older files.
  const auto old = parse_gismo_xml<2, 2>(with(two_patches, "7 2 9 3 1 0 1 0", "7 2 9 3 0"));
  CHECK(old.interfaces()[0].reversed);
}

TEST_CASE("A .g2 file by hand: homogeneous points, default names of a single patch")
{
  const auto surface = parse_g2<2, 3>(one_surface);
  REQUIRE(surface.n_patches() == 1);
  CHECK(surface.patch(0).weights[4] == .5);
  CHECK(surface.control_points().row(4) == Eigen::RowVector3d(1., 1., 2.));
  CHECK(surface.edges().size() == 5);
  CHECK(surface.edge("top").front().side == Side::v_max);
  CHECK(surface.edge("boundary").size() == 4);
  // A colour in the header, and two surfaces on each other's side.
  auto second = with(one_surface, "200 1 0 0", "200 1 0 4 255 0 0 255");
  for (const char *row : {"0 0 0 1\n1 0 0 1\n2 0 0 1\n", "0 .5 1 .5\n.5 .5 1 .5\n1 .5 1 .5\n"})
    second = with(second, row, "");
  second          = with(second, "2 2 2 1\n", "2 2 2 1\n0 3 2 1\n1 3 2 1\n2 3 2 1\n0 4 2 1\n1 4 2 1\n2 4 2 1\n");
  const auto both = parse_g2<2, 3>(one_surface + "\n" + second);
  CHECK(both.n_patches() == 2);
  CHECK(both.interfaces().size() == 1);
}

TEST_CASE("Patches of lower degree are elevated on demand: the surface stays, and how smooth it is")
{
  // Half a cylinder of quadratic arcs along u, straight and linear along v in two elements.
  const std::string text = R"(200 1 0 0
3 1
5 3
0 0 0 1 1 2 2 2
3 2
0 0 .5 1 1
1 0 0 1
.5 .5 0 .5
0 1 0 1
-.5 .5 0 .5
-1 0 0 1
1 0 2 1
.5 .5 1 .5
0 1 2 1
-.5 .5 1 .5
-1 0 2 1
1 0 3 1
.5 .5 1.5 .5
0 1 3 1
-.5 .5 1.5 .5
-1 0 3 1
)";
  CHECK_THAT(about_g2(text), Catch::Contains("degree 2 along u and 1 along v") && Catch::Contains("elevate"));
  // Arcs of this kind are ellipses: their middle weight is 1/2 instead of cos 45 degrees.
  const auto check = [&]<int degree>(const Surface<degree, 3> &surface) {
    const auto &patch = surface.patch(0);
    const auto  whole = [](double u, double v) -> Eigen::Vector3d {
      const double t = u - std::floor(std::min(u, 1.5)), side = u < 1. ? 1. : -1.;
      const double b[] = {(1. - t) * (1. - t), t * (1. - t), t * t}, W = b[0] + b[1] + b[2];
      const double first = (b[0] + b[1]) / W, last = (b[1] + b[2]) / W;
      const double z = v < .5 ? 4. * v : 2. + 2. * (v - .5);
      return {side > 0. ? first : -last, side > 0. ? last : first, z};
    };
    double largest = 0.;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j)
        largest = std::max(largest, (test::position_at(patch, i / 10., j / 20.) - whole(i / 10., j / 20.)).norm());
    CHECK(largest < 1e-14);
    CHECK(split_at_c0_lines(surface).n_patches() == 4);
  };
  check(parse_g2<2, 3>(text, "a.g2", LowerDegree::elevate));
  check(parse_g2<4, 3>(text, "a.g2", LowerDegree::elevate));
  const auto cubic = parse_gismo_xml<3, 2>(two_patches, "a.xml", LowerDegree::elevate);
  CHECK(cubic.interfaces().size() == 1);
  const auto low = parse_gismo_xml<2, 2>(two_patches);
  for (int p = 0; p < 2; ++p)
    for (const double s : {0., .3, .5, 1.})
      for (const double t : {0., .6, 1.})
        {
          const auto  &domain = low.patch(p).basis.domain();
          const double u = domain.min[0] + s * domain.size()[0], v = domain.min[1] + t * domain.size()[1];
          CHECK((test::position_at(cubic.patch(p), u, v) - test::position_at(low.patch(p), u, v)).norm() < 1e-14);
        }
  CHECK(cubic.patch(0).weights == Eigen::VectorXd::Ones(cubic.patch(0).weights.size()));
  CHECK(cubic.patch(0).basis.initial_knots()[1] == std::vector{0., 0., 0., 0., .5, .5, 1., 1., 1., 1.});
  const auto quadratic = [](const std::string &t) { parse_g2<2, 3>(t, "a.g2", LowerDegree::elevate); };
  CHECK_THAT(complaint(quadratic, to_g2(shapes::sphere<3>(1., 2))), Catch::Contains("higher degree"));
}

TEST_CASE("Wrong G+Smo files: line, what was found, what is expected")
{
  using Catch::Contains;
  const auto &good = two_patches;
  CHECK(about_xml(good) == "nothing");
  CHECK_THAT(about_xml(""), Contains("a.xml:1:"));
  CHECK_THAT(about_xml(good.substr(0, good.size() / 2)), Contains("a.xml:") && Contains("malformed XML"));
  CHECK_THAT(about_xml("<html></html>"), Contains("no element <xml>"));
  CHECK_THAT(about_xml("<xml></xml>"), Contains("no <Geometry>"));
  CHECK_THAT(about_xml(with(good, "0 1  1/2 1  1 1", "0 1  1/2 1")),
             Contains("a.xml:10: geometry 7: <coefs> has 22 numbers, expected 24"));
  CHECK_THAT(about_xml(with(good, "1/2 3/4", "1/x 3/4")), Contains("a.xml:13:") && Contains("\"1/x\" is not a number"));
  CHECK_THAT(about_xml(with(good, "1/2 3/4", "1/0 3/4")), Contains("a.xml:13:") && Contains("not finite"));
  CHECK_THAT(about_xml(with(good, "2 2 2 2", "2 2 0 2")), Contains("a.xml:23:") && Contains("weight 7 is 0"));
  CHECK_THAT(about_xml(with(good, "2 2 2 2", "2 2 2")), Contains("<weights> has 11 numbers, expected 12"));
  CHECK_THAT(about_xml(with(good, ".5 1 1 1", "1.5 1 1 1")),
             Contains("a.xml:8:") && Contains("knot 1 comes after 1.5"));
  CHECK_THAT(about_xml(with(good, "0 0 0 .5 1 1 1", "0 0 .2 .5 1 1 1")), Contains("open knot vector"));
  CHECK_THAT(about_xml(with(good, "0 0 0 .5 1 1 1", "0 0 0 .5 .5 .5 1 1 1")), Contains("more than degree = 2"));
  CHECK_THAT(about_xml(with(good, "degree=\"2\"", "degree=\"1\"")), Contains("a.xml:7:"));
  CHECK_THAT(about_xml(with(good, "<KnotVector degree=\"2\">0 0 0 1 1 1</KnotVector>",
                            "<KnotVector degree=\"3\">0 0 0 0 1 1 1 1</KnotVector>")),
             Contains("24 numbers, expected 32"));
  CHECK_THAT(about_xml(with(good, "TensorBSpline2", "TensorBSpline3")), Contains("a volume") && Contains("a.xml:5:"));
  CHECK_THAT(about_xml(with(good, "TensorBSpline2", "THBSpline2")), Contains("hierarchical"));
  CHECK_THAT(about_xml(with(good, "geoDim=\"2\"", "geoDim=\"1\"")), Contains("24 numbers, expected 12"));
  CHECK_THAT(about_xml(with(good, "index=\"1\"", "index=\"0\"")), Contains("index 0 and 1"));
  CHECK_THAT(about_xml(with(good, "id_index\">7 9", "id_index\">7 9 8")), Contains("geometry 8"));
  CHECK_THAT(about_xml(with(good, "7 2 9 3 1 0 1 0", "7 2 9 5 1 0 1 0")), Contains("side 5") && Contains("1 to 4"));
  CHECK_THAT(about_xml(with(good, "7 2 9 3 1 0 1 0", "7 2 9 3 0 1 1 0")), Contains("directions do not fit"));
  CHECK_THAT(about_xml(with(good, "7 2 9 3 1 0 1 0", "7 2 9 3 1 0")), Contains("6 numbers, expected 8"));
  CHECK_THAT(about_xml(with(good, "parDim=\"2\"", "parDim=\"3\"")), Contains("parDim 3"));
  CHECK_THAT(about_xml(with(good, "7 2 9 3 1 0 1 0", "7 2 9 4 1 0 1 0")), Contains("a.xml:31:"));
  const auto cubic = [](const std::string &text) { parse_gismo_xml<3, 2>(text, "a.xml"); };
  CHECK_THAT(complaint(cubic, good), Contains("degree 2 along u and 2 along v, expected 3") && Contains("elevate"));
  const auto planar = [](const std::string &text) { parse_gismo_xml<4, 2>(text, "a.xml"); };
  CHECK_THAT(complaint(planar, to_gismo_xml(shapes::sphere<4>(1., 1))), Contains("3 dimensions, expected 2"));
}

TEST_CASE("Wrong .g2 files: line, what was found, what is expected")
{
  using Catch::Contains;
  const auto &good = one_surface;
  CHECK(about_g2(good) == "nothing");
  CHECK_THAT(about_g2(" \n"), Contains("a.g2:1:") && Contains("empty"));
  CHECK_THAT(about_g2(with(good, "2 2 2 1\n", "")), Contains("a.g2:15:") && Contains("32 numbers, expected 36"));
  CHECK_THAT(about_g2(good + "1.5\n"), Contains("a.g2:16:") && Contains("\"1.5\""));
  CHECK_THAT(about_g2(with(good, "200 1", "700 1")), Contains("a spline volume") && Contains("expected 200"));
  CHECK_THAT(about_g2(with(good, "200 1", "100 1")), Contains("a spline curve"));
  CHECK_THAT(about_g2(with(good, "200 1", "200 2")), Contains("2.0, expected 1.0"));
  CHECK_THAT(about_g2(with(good, "3 1\n", "3 2\n")), Contains("a.g2:2:") && Contains("expected 0 (polynomial)"));
  CHECK_THAT(about_g2(with(good, "3 1\n", "1 1\n")), Contains("a.g2:"));
  CHECK_THAT(about_g2(with(good, "0 0 0 2 2 2", "0 0 2 0 2 2")),
             Contains("a.g2:5:") && Contains("knot 0 comes after 2"));
  CHECK_THAT(about_g2(with(good, ".5 .5 1 .5", ".5 .5 1 -.5")), Contains("a.g2:11:") && Contains("weight 5 is -0.5"));
  CHECK_THAT(about_g2(with(good, ".5 .5 1 .5", ".5 half 1 .5")), Contains("a.g2:11:") && Contains("\"half\""));
  const auto cubic = [](const std::string &text) { parse_g2<3, 3>(text, "a.g2"); };
  CHECK_THAT(complaint(cubic, good), Contains("a.g2:1:") && Contains("expected 3 along both"));
}

TEST_CASE("Whatever is wrong with a text, the answer is a FileError")
{
  const auto survives = [](const std::string &text, const auto &parse) {
    try
      {
        parse(text);
        return true;
      }
    catch (const FileError &error)
      {
        return std::string(error.what()).starts_with("a:");
      }
    catch (const std::exception &error)
      {
        UNSCOPED_INFO(error.what());
        return false;
      }
  };
  const auto xml = [](const std::string &text) { parse_gismo_xml<2, 2>(text, "a"); };
  const auto g2  = [](const std::string &text) { parse_g2<2, 3>(text, "a"); };
  const auto all = [&](const std::string &good, const auto &parse) {
    int failures = 0;
    for (std::size_t n = 0; n < good.size(); ++n)
      failures += !survives(good.substr(0, n), parse);
    CHECK(failures == 0);
    const std::string separators = " \n<>\"=";
    for (std::size_t begin = good.find_first_not_of(separators); begin != good.npos;)
      {
        const auto end = std::min(good.find_first_of(separators, begin), good.size());
        for (const char *word : {"0", "-1", "3", "5", "2147483647", "1e308", "nan", "x", "1/0", ""})
          if (const auto bad = good.substr(0, begin) + word + good.substr(end); !survives(bad, parse))
            {
              UNSCOPED_INFO(bad);
              ++failures;
            }
        begin = good.find_first_not_of(separators, end);
      }
    CHECK(failures == 0);
  };
  all(one_surface, g2);
  all(two_patches, xml);
}

TEST_CASE("Surfaces that the formats cannot hold are refused")
{
  auto plate = shapes::plate<2, 3>({1., 1.}, {4, 4});
  plate.refine({0}, {{.5, .5}});
  CHECK_THROWS_WITH(to_g2(plate), Catch::Contains("refined locally"));
  CHECK_THROWS_WITH(to_gismo_xml(plate), Catch::Contains("refined locally"));
}

TEST_CASE("Files are written by one rank and read by all; a missing one is an error on all")
{
  const Environment env(MPI_COMM_WORLD);
  const auto        id     = broadcast(env.comm(), std::to_string(getpid()));
  const auto        folder = std::filesystem::temp_directory_path() / ("sherd-geometry-" + id);
  if (env.rank() == 0)
    std::filesystem::create_directories(folder);
  const auto sphere = shapes::sphere<2>(1., 2);
  write_gismo_xml(env, folder / "sphere.xml", sphere);
  write_g2(env, folder / "sphere.g2", sphere);
  CHECK(test::identical(read_gismo_xml<2, 3>(env, folder / "sphere.xml"), sphere));
  CHECK(read_g2<2, 3>(env, folder / "sphere.g2").interfaces().size() == 12);
  CHECK_THROWS_WITH((read_g2<2, 3>(env, folder / "none.g2")), Catch::Contains("none.g2"));
  CHECK_THROWS_AS((read_gismo_xml<2, 3>(env, folder)), FileError);
  MPI_Barrier(env.comm());
  if (env.rank() == 0)
    std::filesystem::remove_all(folder);
}
