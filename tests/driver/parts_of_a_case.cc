#include <catch2/catch.hpp>

#include <sherd/base/environment.h>
#include <sherd/driver/case_model.h>
#include <sherd/driver/make_surface.h>
#include <sherd/material/canham.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>

#include "read_case.h"

using namespace sherd;
using namespace sherd::test;
using Catch::Matchers::Contains;

namespace
{

const std::string plane = "material: {constants: lame, first_lame: 2, shear_modulus: 1}\n";
const std::string shell = "surface: {dimension: 3}\n"
                          "material: {constants: solid, youngs_modulus: 10, poissons_ratio: 0.3, thickness: 0.1}\n";

Case resolved(const std::string &text)
{
  auto prm = read_case(smallest_case + text);
  prm.resolve();
  return prm;
}

/// A point of a bent and stretched sheet over the unit square.
SurfacePoint<3> bent_point()
{
  const ReferencePoint<3> reference(metric(Voigt(1., 1., 0.)), Voigt::Zero());
  return SurfacePoint<3>(reference, metric(Voigt(1.02, 1.01, .003)), Voigt(.3, -.2, .05));
}

} // namespace

TEST_CASE("Every split and its laws come by name")
{
  const auto point = bent_point();
  for (const std::string split :
       {"none", "surface_stretch", "spectral_layer", "spectral_membrane", "volumetric_deviatoric_layer"})
    {
      INFO(split);
      auto prm              = resolved(plane);
      prm.material.split    = split;
      prm.material.membrane = prm.material.bending = "default";
      prm.material.resolve(2);
      const auto flat     = make_split<2>(prm.material);
      const auto response = flat.respond(point);
      CHECK(response.energy_active + response.energy_passive > 0.);
      CHECK(flat.bulk() == Approx(3.));
      CHECK(flat.shear() == Approx(1.));

      auto thick              = resolved(shell);
      thick.material.split    = split;
      thick.material.membrane = thick.material.bending = "default";
      thick.material.resolve(3);
      const auto curved = make_split<3>(thick.material);
      const auto bent   = curved.respond(point);
      CHECK(bent.energy_active > 0.);
      CHECK(bent.energy_passive >= 0.);
      CHECK(curved.bending().stiffness() == Approx(10. * 1e-3 / (12. * (1. - .09))));
    }
}

TEST_CASE("A split that is chosen at run time answers as the type it holds")
{
  const auto                                                        point = bent_point();
  const material::Sheet                                             sheet = material::sheet_of_solid(10., .3, .1);
  const split::SurfaceStretch<material::NeoHooke, material::Canham> chosen(sheet);
  const split::Any<3>                                               any(chosen);
  const auto                                                        a = any.respond(point), b = chosen.respond(point);
  CHECK(a.energy_active == b.energy_active);
  CHECK(a.energy_passive == b.energy_passive);
  CHECK(a.stress_active.moment == b.stress_active.moment);
  CHECK(a.tangent_passive.bending == b.tangent_passive.bending);
  CHECK(any.bending().stiffness() == chosen.bending().stiffness());
}

TEST_CASE("Every shape is made from its defaults")
{
  const Environment env(MPI_COMM_SELF);
  auto              prm = resolved(shell).surface;
  ShapeParameters().for_each([&](const std::string &name, auto &, int dimensions, const std::string &) {
    if (name == "file")
      return;
    INFO(name);
    prm.shape          = name;
    const auto surface = make_surface<2, 3>(env, prm);
    CHECK(surface.n_elements() > 0);
    if (dimensions == 2)
      CHECK(make_surface<3, 2>(env, prm).n_elements() == surface.n_elements());
    else
      CHECK_THAT(refusal([&] { make_surface<2, 2>(env, prm); }), Contains("dimension"));
  });
  prm.shape = "plate";
  prm.cut   = {2, 3};
  CHECK(make_surface<2, 3>(env, prm).n_patches() == 6);
  prm.cut                      = {1, 1};
  prm.shape                    = "notched_plate";
  prm.shapes.notched_plate.tip = {.25, .75};
  const auto notched           = make_surface<2, 2>(env, prm);
  CHECK(notched.interfaces().size() == 3); // of the four patches around the tip: the slit is open
  const auto face = points_along(notched, notched.edge("upper_face").front());
  CHECK((notched.control_points().row(face.back()).transpose() - Point<2>(.25, .75)).norm() < 1e-14);
  prm.shape            = "file";
  prm.shapes.file.name = "sheet.step";
  CHECK_THAT(refusal([&] { make_surface<2, 3>(env, prm); }), Contains(".xml") && Contains(".g2"));
}

TEST_CASE("Regions multiply toughness and stiffness inside, with a ramp")
{
  const auto prm = resolved(plane + "regions:\n"
                                    "  - {kind: box, lower: [0, 0], upper: [1, 1], toughness: 10, transition: 0.2}\n"
                                    "  - {kind: ball, centre: [3, 0], radius: 0.5, stiffness: 4}\n");
  const auto Gc  = make_toughness<2>(prm);
  const auto E   = make_stiffness<2>(prm);
  CHECK(Gc(Point<2>(.5, .5)) == Approx(10.));
  CHECK(Gc(Point<2>(1., .5)) == Approx(5.5)); // half-way
  CHECK(Gc(Point<2>(1.2, .5)) == Approx(1.));
  CHECK(E(Point<2>(3.1, .1)) == Approx(4.));
  CHECK(E(Point<2>(.5, .5)) == Approx(1.));

  const auto wrong = resolved(plane + "regions: [{kind: ball, centre: [0, 0, 0], radius: 1}]\n");
  CHECK_THAT(refusal([&] { make_toughness<2>(wrong); }), Contains("regions.0") && Contains("2 coordinates"));
}

TEST_CASE("A crack on a sphere follows the great circle between its ends")
{
  const Environment env(MPI_COMM_SELF);
  const auto        prm    = resolved(shell + "cracks: [{points: [[0.6, 0, 0.8], [0, 0.8, 0.6]], on_surface: true}]\n");
  auto              sphere = prm.surface;
  sphere.shape             = "sphere";
  const auto cracks        = make_cracks(prm, make_surface<2, 3>(env, sphere));
  REQUIRE(cracks.cracks().size() == 1);
  const auto &points = cracks.cracks()[0].points();
  CHECK(points.size() == 65);
  const Point<3> normal = points.front().cross(points.back()).normalized();
  for (const auto &X : points)
    {
      CHECK(X.norm() == Approx(1.).epsilon(1e-4)); // the sphere of 8 elements is off by 1e-5
      CHECK(std::abs(X.dot(normal)) < 1e-4);
    }
}

TEST_CASE("Supports and loads of a case are those of the library")
{
  const auto prm = resolved(plane + "supports:\n"
                                    "  - {kind: fix, edges: [left, right], component: x}\n"
                                    "  - {kind: prescribe, corner: [left, top], component: y, displacement: 3 * t}\n"
                                    "  - {kind: symmetry, edges: [bottom], component: y}\n"
                                    "loads:\n"
                                    "  - {kind: traction, edges: [top], vector: [x + 1, 2 * t]}\n"
                                    "  - {kind: gravity, vector: [0, -9.81]}\n");
  Supports   supports;
  for (const auto &support : prm.supports)
    support.add_to(supports, 2, "supports");
  REQUIRE(supports.list().size() >= 3);
  CHECK(supports.list()[2].displacement(2.) == Approx(6.));
  CHECK(supports.symmetries().size() == 1);

  Loads<2> loads;
  for (const auto &load : prm.loads)
    load.add_to(loads, 5., "loads");
  CHECK(loads.tractions()[0].traction(Point<2>(3., 0.), 4.) == Point<2>(4., 8.));

  const auto refused = [](const std::string &words) {
    const auto wrong = resolved(plane + words);
    return refusal([&] {
      Supports supports;
      Loads<2> loads;
      for (const auto &support : wrong.supports)
        support.add_to(supports, 2, "supports.0");
      for (const auto &load : wrong.loads)
        load.add_to(loads, 5., "loads.0");
    });
  };
  CHECK_THAT(refused("supports: [{kind: fix}]\n"), Contains("holds nothing"));
  CHECK_THAT(refused("supports: [{kind: clamp, patch: 0}]\n"), Contains("for edges"));
  CHECK_THAT(refused("supports: [{kind: prescribe, edges: [top], displacement: t}]\n"), Contains("needs a component"));
  CHECK_THAT(refused("supports: [{edges: [top], component: z}]\n"), Contains("in the plane"));
  CHECK_THAT(refused("supports: [{edges: [top], displacement: t}]\n"), Contains("has no displacement"));
  CHECK_THAT(refused("loads: [{kind: pressure, value: 1}]\n"), Contains("acts on shells"));
  CHECK_THAT(refused("loads: [{kind: traction, edges: [top], vector: [1, 2, 3]}]\n"), Contains("3 components"));
  CHECK_THAT(refused("loads: [{kind: traction, vector: [1, 2]}]\n"), Contains("edges is missing"));
}
