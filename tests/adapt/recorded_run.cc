// label: verification
#include <catch2/catch.hpp>

#include <cmath>

#include <output/temporary_folder.h>
#include <sherd/output/recorded_run.h>
#include <sherd/output/vtu.h>

#include "cracking_plate.h"

using namespace sherd;
using namespace sherd::test;

namespace
{

constexpr double end = .02, step = .003;

const RecorderSettings<2> recording{
    .crack = {.length_scale = 1., .rayleigh_speed = 50., .target_size = 2.}, .end_time = end, .frames = 7};

/// Times of the frames that a recorded run leaves behind, as they are in frames.pvd, and its number of steps.
struct Frames
{
  std::vector<double> times;
  int                 n_steps;
};

Frames run(const StepControlSettings &steps)
{
  const ::test::TemporaryFolder folder;
  CommandLine                   command_line;
  command_line.output_directory = (folder.path() / "output").string();
  const Environment env(MPI_COMM_WORLD, command_line);
  CrackingPlate     body(MPI_COMM_WORLD, {.target = 10.});
  body.controller = StepController(steps);
  body.solver.rebuild(body.state);
  body.controller.bound(body.solver.assembler().shortest_edge(), body.solver.rayleigh_speed());
  REQUIRE(body.controller.step() == step);

  const OutputDirectory directory(env);
  directory.prepare();
  std::ofstream(directory.file("used.yaml")) << "{}\n"; // a checkpoint would repeat it
  const std::optional<Checkpoint<2, 2>> none;
  RecordedRun recorded(env, directory, body.plate, none, recording, {}, body.solver, body.space, body.state,
                       body.controller);
  while (body.state.time < end)
    recorded.step([&] { return body.advance(end); });
  recorded.finish();
  CHECK(body.state.time == end);
  Frames frames;
  for (const auto &entry : read_pvd(directory.file("frames.pvd")))
    frames.times.push_back(entry.time);
  frames.n_steps = static_cast<int>(body.state.step);
  return frames;
}

} // namespace

TEST_CASE("Steps of a recorded run end exactly at the evenly spaced frames if they are asked to")
{
  const auto missed = run({.initial = step, .rule = StepRule::fixed});
  const auto hit    = run({.initial = step, .rule = StepRule::fixed, .hit_frames = true});
  const auto given  = run({.initial = step, .rule = StepRule::fixed, .times = {.0041}, .hit_frames = true});

  // Frames are due at multiples of 0.02 / 7, which no step of 0.003 meets but by chance; the last one is the end.
  REQUIRE(missed.times.size() == 8);
  REQUIRE(hit.times.size() == 8);
  REQUIRE(given.times.size() == 9);
  CHECK(hit.times[0] == 0.);
  for (int k = 1; k < 7; ++k)
    {
      CAPTURE(k);
      CHECK(hit.times[k] == recording.frame_time(k));
      CHECK(missed.times[k] > recording.frame_time(k));
      CHECK(missed.times[k] < recording.frame_time(k) + step);
    }
  CHECK(hit.times[7] == end);
  CHECK(missed.times[7] == end);
  CHECK(hit.n_steps == 7);

  // Times that are given besides get frames of their own.
  CHECK(given.times[2] == .0041);
  auto others = given.times;
  others.erase(others.begin() + 2);
  CHECK(others == hit.times);
}
