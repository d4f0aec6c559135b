// label: unit
// ranks: 1 2 3 5
#include <catch2/catch.hpp>

#include <fstream>
#include <limits>
#include <random>
#include <set>

#include <base/temporary_directory.h>
#include <geometry/sample_surfaces.h>
#include <sherd/base/text_file.h>
#include <sherd/base/timers.h>
#include <sherd/output/checkpoint_writer.h>
#include <sherd/output/restart.h>
#include <space/shared_out.h>

#include "rational_surfaces.h"
#include "temporary_folder.h"

using namespace sherd;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace
{

template <class Values>
std::vector<double> list(const Values &values)
{
  return {values.data(), values.data() + values.size()};
}

/// Equal bits, be they those of -0 or NaN.
void check_bits(const std::vector<double> &found, const std::vector<double> &wanted)
{
  REQUIRE(found.size() == wanted.size());
  CHECK(std::memcmp(found.data(), wanted.data(), found.size() * sizeof(double)) == 0);
}

template <int degree, int spacedim>
GlobalState<degree, spacedim> random_state(const Surface<degree, spacedim> &surface)
{
  std::mt19937 random(5);
  const auto   fill = [&](auto &values, int rows, int columns) {
    values.resize(rows, columns);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values.data()[i] = sherd::test::symmetric(random);
  };
  GlobalState<degree, spacedim> state;
  const int                     n = surface.n_control_points();
  fill(state.position, n, spacedim);
  fill(state.velocity, n, spacedim);
  fill(state.acceleration, n, spacedim);
  fill(state.phase, n, 1);
  fill(state.previous_phase, n, 1);
  fill(state.history, surface.n_elements(), state.n_q);
  state.velocity(0, 0)     = -0.;
  state.acceleration(0, 0) = std::numeric_limits<double>::denorm_min();
  state.history(0, 0)      = std::nextafter(1., 2.);
  state.time               = 0.1 + 0.2;
  state.step_size          = 1. / 3.;
  state.step               = 42;
  return state;
}

RecorderMemory some_memory()
{
  RecorderMemory memory;
  memory.balance              = {0.1,
                                 {.active = 1. / 3., .passive = 2., .kinetic = 3., .fracture = 4., .bending = .5},
                                 {5., {5.25, 5.5}},
                                 6.,
                                 6.25,
                                 6.5,
                                 6.75,
                                 7.};
  memory.energies             = {.active = 8., .passive = 9., .kinetic = 10., .fracture = 1. / 7.};
  memory.totals               = {.steps = 1, .attempts = 2, .rejected = 3, .repeated = 4, .switched = 5, .refined = 6};
  memory.totals.newton        = 7;
  memory.totals.linear        = 8;
  memory.last.step            = 42;
  memory.last.time            = 0.1 + 0.2;
  memory.last.dofs            = 1L << 40;
  memory.last.tip_speed       = 1. / 9.;
  memory.largest_elastic      = 11.;
  memory.largest_elastic_time = 12.;
  memory.largest_imbalance    = 13.;
  memory.n_frames             = 14;
  memory.wall_seconds         = 15.;
  memory.phase_seconds        = {{"assembly", 1.5}, {"branch check", 0.25}};
  memory.cracks.time          = 0.3;
  memory.cracks.tips          = {{0, -1, true, {1., 2., 3.}, {4., 5., 6.}, 7., 8., {{0.1, 6.}, {0.3, 7.}}},
                                 {1, 0, false, {-1., -2., 0.}, {0., 0., 0.}, 1. / 3., 0., {}}};
  memory.cracks.branchings    = {{0.2, {1., 1. / 3., 0.}, 0, 1}};
  return memory;
}

template <int degree, int spacedim>
Checkpoint<degree, spacedim> some_checkpoint(const Surface<degree, spacedim> &surface)
{
  return {surface,
          random_state(surface),
          {1e-7, std::numeric_limits<double>::infinity()},
          some_memory(),
          "plate:\n  size: [1, 2]\n"};
}

template <int degree, int spacedim>
void check_same(const Surface<degree, spacedim> &found, const Surface<degree, spacedim> &wanted)
{
  REQUIRE(found.n_patches() == wanted.n_patches());
  for (int p = 0; p < wanted.n_patches(); ++p)
    {
      const auto &a = found.patch(p), &b = wanted.patch(p);
      const auto  parts = a.basis.parts(), other = b.basis.parts();
      CHECK(parts.initial_knots == other.initial_knots);
      CHECK(parts.lines == other.lines);
      CHECK(parts.elements == other.elements);
      REQUIRE(parts.functions.size() == other.functions.size());
      for (std::size_t i = 0; i < parts.functions.size(); ++i)
        CHECK((parts.functions[i].knots == other.functions[i].knots &&
               parts.functions[i].gamma == other.functions[i].gamma));
      check_bits(list(a.control_points), list(b.control_points));
      check_bits(list(a.weights), list(b.weights));
    }
  REQUIRE(found.edges().size() == wanted.edges().size());
  for (const auto &[name, sides] : wanted.edges())
    {
      const auto &others = found.edge(name);
      REQUIRE(others.size() == sides.size());
      for (std::size_t k = 0; k < sides.size(); ++k)
        CHECK((others[k].patch == sides[k].patch && others[k].side == sides[k].side));
    }
}

template <int degree, int spacedim>
void check_same(const GlobalState<degree, spacedim> &found, const GlobalState<degree, spacedim> &wanted)
{
  check_bits(list(found.position), list(wanted.position));
  check_bits(list(found.velocity), list(wanted.velocity));
  check_bits(list(found.acceleration), list(wanted.acceleration));
  check_bits(list(found.phase), list(wanted.phase));
  check_bits(list(found.previous_phase), list(wanted.previous_phase));
  check_bits(list(found.history), list(wanted.history));
  check_bits({found.time, found.step_size}, {wanted.time, wanted.step_size});
  CHECK(found.step == wanted.step);
}

Surface<2, 2> refined_plate()
{
  auto surface = shapes::plate<2, 2>({2., 1.}, {6, 4});
  sherd::test::refine_at_random(surface, 2, 3, 73);
  return surface;
}

/// The message of the error, empty if there is none.
template <class Task>
std::string message_of(const Task &task)
{
  try
    {
      task();
    }
  catch (const Error &error)
    {
      return error.what();
    }
  return "";
}

void replace(const fs::path &file, const std::string &bytes)
{
  on_root(MPI_COMM_WORLD, [&] { std::ofstream(file, std::ios::binary) << bytes; });
}

/// What CheckpointWriter needs of a solver.
struct FakeSolver
{
  PhaseTimers  clock;
  int          n_rebuilt = 0;
  PhaseTimers &timers() { return clock; }
  void         rebuild(const State<2, 2> &) { ++n_rebuilt; }
};

struct Writing
{
  explicit Writing(const fs::path &path)
      : env(MPI_COMM_WORLD, line(path)), directory(env), space(env, plate), state(space)
  {
    directory.prepare();
    write_text(env, directory.file("used.yaml"), "a: 1\n");
  }

  static CommandLine line(const fs::path &path)
  {
    CommandLine result;
    result.program          = "step-7";
    result.output_directory = path.string();
    return result;
  }

  void write(CheckpointWriter &writer, int step)
  {
    state.step = step;
    writer.write(solver, space, state, controller, some_memory());
  }

  Surface<2, 2>    plate = refined_plate();
  Environment      env;
  OutputDirectory  directory;
  ShellSpace<2, 2> space;
  State<2, 2>      state;
  StepController   controller{StepControlSettings{.initial = 1.}};
  FakeSolver       solver;
};

int step_in(const Environment &env, const fs::path &file)
{
  return read_checkpoint<2, 2>(env, file).state.step;
}

struct Numbers
{
  double a = 1., b = 2.;
  void   declare(ParameterSection &section)
  {
    section.value("a", a, "m", range::any(), "first");
    section.value("b", b, "m", range::any(), "second");
  }
};
struct Case
{
  Numbers fixed, free;
  void    declare(ParameterSection &section)
  {
    section.subsection("fixed", fixed, "what decides the body");
    section.subsection("free", free, "what does not");
  }
};

} // namespace

TEMPLATE_TEST_CASE_SIG("A checkpoint is read as it was written, bit by bit, in the plane", "[output][checkpoint]",
                       ((int degree), degree), 2, 3, 4)
{
  const sherd::test::TemporaryDirectory folder;
  const Environment                     env(MPI_COMM_WORLD);
  const auto                            file    = folder.path() / "checkpoint.h5";
  auto                                  surface = shapes::plate<degree, 2>({2., 1.}, {6, 4});
  sherd::test::refine_at_random(surface, 2, 3, 73);
  const auto wanted = some_checkpoint(surface);
  on_root(env.comm(), [&] { write_checkpoint(file, wanted); });

  const auto found = read_checkpoint<degree, 2>(env, file);
  check_same(found.surface, wanted.surface);
  check_same(found.state, wanted.state);
  CHECK(found.parameters == wanted.parameters);
  check_bits({found.controller.step, found.controller.largest, found.controller.previous_error},
             {wanted.controller.step, wanted.controller.largest, wanted.controller.previous_error});
}

TEST_CASE("A checkpoint is read as it was written, bit by bit, in space", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  const Environment                     env(MPI_COMM_WORLD);
  const auto                            file   = folder.path() / "checkpoint.h5";
  const auto                            wanted = some_checkpoint(::test::refined_quarter_cylinder());
  on_root(env.comm(), [&] { write_checkpoint(file, wanted); });

  const auto found = read_checkpoint<2, 3>(env, file);
  check_same(found.surface, wanted.surface);
  check_same(found.state, wanted.state);
}

TEST_CASE("The memory of a recorder comes back, tips and their ways included", "[output][checkpoint]")
{
  StoredArrays arrays;
  const auto   wanted = some_memory();
  put(ArrayWriter(arrays).in("recorder"), wanted);
  const auto found = get_recorder_memory(ArrayReader(arrays).in("recorder"));

  // Written once more, every array is the same; so only a member that was never listed could differ.
  StoredArrays again;
  put(ArrayWriter(again).in("recorder"), found);
  REQUIRE(again.all().size() == arrays.all().size());
  for (const auto &[name, array] : arrays.all())
    {
      INFO(name);
      CHECK(again.find(name).shape == array.shape);
      CHECK(again.find(name).values == array.values);
    }
  CHECK(found.balance.now.active == wanted.balance.now.active);
  CHECK(found.balance.now.bending == wanted.balance.now.bending);
  CHECK(found.balance.work.supports == 5.);
  CHECK(found.balance.work.loads == std::vector{5.25, 5.5});
  CHECK(found.balance.irreversible == wanted.balance.irreversible);
  CHECK(found.balance.dissipation == wanted.balance.dissipation);
  CHECK(found.balance.inertial_dissipation == wanted.balance.inertial_dissipation);
  CHECK(found.balance.refinement == wanted.balance.refinement);
  CHECK(found.totals.linear == wanted.totals.linear);
  CHECK(found.last.dofs == wanted.last.dofs);
  CHECK(found.last.tip_speed == wanted.last.tip_speed);
  CHECK(found.phase_seconds == wanted.phase_seconds);
  CHECK(found.cracks.time == wanted.cracks.time);
  REQUIRE(found.cracks.tips.size() == 2);
  CHECK(found.cracks.tips[0].anchor == wanted.cracks.tips[0].anchor);
  CHECK(found.cracks.tips[0].recent.at(1).length == 7.);
  CHECK(found.cracks.tips[1].recent.empty());
  CHECK(found.cracks.tips[1].parent == 0);
  CHECK_FALSE(found.cracks.tips[1].active);
  REQUIRE(found.cracks.branchings.size() == 1);
  CHECK(found.cracks.branchings[0].X == wanted.cracks.branchings[0].X);
}

TEST_CASE("A checkpoint does not know the number of ranks that wrote it", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  const Environment                     world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  const auto                            surface     = refined_plate();
  const auto                            global      = random_state(surface);
  const auto                            gathered_on = [&](const Environment &env) {
    const ShellSpace<2, 2> space(env, surface);
    return gather(distribute(global, space), space);
  };
  const auto by_one = folder.path() / "one.h5", by_all = folder.path() / "all.h5";
  auto       checkpoint = some_checkpoint(surface);
  for (const bool one : {true, false})
    {
      checkpoint.state = gathered_on(one ? alone : world);
      on_root(world.comm(), [&] { write_checkpoint(one ? by_one : by_all, checkpoint); });
    }

  CHECK((::test::content(by_one) == ::test::content(by_all)));
  // Read by one rank, by all, by two of them, and with one that owns nothing.
  MPI_Comm two;
  MPI_Comm_split(MPI_COMM_WORLD, world.rank() / 2, 0, &two);
  const Environment pair(two);
  for (const auto *env : {&alone, &world, &pair})
    for (const auto &partitioner : {Partitioner(partition), ::sherd::test::leaving_out(env->n_ranks() / 2)})
      {
        const auto             found = read_checkpoint<2, 2>(*env, by_all);
        const ShellSpace<2, 2> space(*env, found.surface, continuity::Penalty(), partitioner);
        check_same(gather(distribute(found.state, space), space), global);
      }
  MPI_Comm_free(&two);
}

TEST_CASE("A damaged checkpoint is refused with a message, whatever was hit", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  const Environment                     env(MPI_COMM_WORLD);
  const auto file = folder.path() / "checkpoint.h5", other = folder.path() / "checkpoint.1.h5";
  on_root(env.comm(), [&] { write_checkpoint(file, some_checkpoint(refined_plate())); });
  const auto bytes   = read_text(env, file);
  const auto refusal = [&] { return message_of([&] { read_checkpoint<2, 2>(env, file); }); };
  REQUIRE(refusal().empty());

  std::mt19937 random(3);
  for (int k = 0; k < 40; ++k)
    {
      // One bit: of the three lines of the head that are read, or of the content.
      auto       damaged = bytes;
      const auto at      = k < 10 ? random() % 65 : 512 + random() % (bytes.size() - 512);
      damaged[at]        = static_cast<char>(damaged[at] ^ (1 << random() % 8));
      replace(file, damaged);
      INFO("byte " << at);
      CHECK_THROWS_AS(read_checkpoint_bytes(file), FileError);
      MPI_Barrier(env.comm());
    }
  auto damaged = bytes;
  damaged[bytes.size() / 2] ^= 1;
  replace(file, damaged);
  CHECK_THAT(refusal(), Contains("checkpoint.h5") && Contains("damaged"));

  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t(600), std::size_t(512)})
    {
      replace(file, bytes.substr(0, size));
      CHECK_THAT(refusal(), Contains("truncated"));
    }
  for (const std::string text : {"", "history: 3\n"})
    {
      replace(file, text);
      CHECK_THAT(refusal(), Contains("no checkpoint"));
    }
  CHECK_THAT(refusal(), !Contains("--restart"));

  // A whole one beside it is offered.
  replace(other, bytes);
  CHECK_THAT(refusal(), Contains("--restart " + other.string()));
  CHECK_THAT(message_of([&] { read_checkpoint<2, 2>(env, folder.path() / "none.h5"); }),
             Contains("no such file") && Contains("--restart " + other.string()));
}

TEST_CASE("A checkpoint of another layout, degree, dimension or surface is refused", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  CommandLine                           line;
  line.restart = (folder.path() / "checkpoint.h5").string();
  const Environment env(MPI_COMM_WORLD, line);
  const fs::path    file = *line.restart;
  on_root(env.comm(), [&] { write_checkpoint(file, some_checkpoint(refined_plate())); });

  CHECK_THAT(message_of([&] { read_checkpoint<3, 2>(env, file); }), Contains("degree 2 in 2d") && Contains("degree 3"));
  CHECK_THAT(message_of([&] { read_checkpoint<2, 3>(env, file); }), Contains("2 in 3d"));
  CHECK_THAT(message_of([&] {
               restart_checkpoint(env, shapes::plate<2, 2>({2., 1.}, {6, 5}));
             }),
             Contains("no refinement"));
  CHECK(restart_checkpoint(env, shapes::plate<2, 2>({2., 1.}, {6, 4})));
  CHECK_FALSE(restart_checkpoint(Environment(MPI_COMM_WORLD), shapes::plate<2, 2>({2., 1.}, {6, 5})));

  auto       bytes = read_text(env, file);
  const auto own   = std::to_string(checkpoint_format);
  const auto at    = bytes.find("layout " + own);
  REQUIRE(at < 64);
  bytes[at + 7] = '9';
  replace(file, bytes);
  CHECK_THAT(message_of([&] { read_checkpoint<2, 2>(env, file); }),
             Contains("version 9") && Contains("version " + own));
}

TEST_CASE("CheckpointWriter: keeps the newest and some older ones", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  Writing                               run(folder.path());
  const auto                            name  = [&](int age) { return folder.path() / checkpoint_name(age); };
  const auto                            steps = [&] {
    std::vector<int> result;
    for (int age = 0; fs::exists(name(age)); ++age)
      result.push_back(step_in(run.env, name(age)));
    MPI_Barrier(run.env.comm());
    return result;
  };
  {
    CheckpointWriter writer(run.env, run.directory, {.steps = 10, .minutes = 0., .keep = 3});
    CHECK((writer.due(20) && !writer.due(21)));
    for (const int step : {10, 20, 30, 40, 50})
      run.write(writer, step);
    CHECK(run.solver.n_rebuilt == 5);
    CHECK(writer.advice() == "go on with step-7 --restart " + name(0).string());
  }
  CHECK(steps() == std::vector<int>{50, 40, 30});
  CHECK(read_checkpoint<2, 2>(run.env, name(0)).parameters == "a: 1\n");

  // One that cannot be written leaves the others.
  auto line    = run.env.command_line();
  line.restart = name(0).string();
  const Environment again(MPI_COMM_WORLD, line);
  {
    CheckpointWriter writer(again, OutputDirectory(again), {.steps = 10, .minutes = 0., .keep = 3});
    on_root(run.env.comm(), [&] { fs::create_directory(folder.path() / "checkpoint.h5.part"); });
    CHECK_THROWS_AS(run.write(writer, 60), FileError);
    on_root(run.env.comm(), [&] { fs::remove(folder.path() / "checkpoint.h5.part"); });
    CHECK(steps() == std::vector<int>{50, 40, 30});
  }

  // A restart from an older one forgets those that came after it; fewer to keep, fewer files.
  line.restart = name(1).string();
  const Environment from_older(MPI_COMM_WORLD, line);
  CheckpointWriter  writer(from_older, OutputDirectory(from_older), {.keep = 1});
  CHECK(steps() == std::vector<int>{40, 30});
  run.write(writer, 45);
  CHECK(steps() == std::vector<int>{45});
}

TEST_CASE("CheckpointWriter: by wall time", "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  Writing                               run(folder.path());
  CHECK(CheckpointWriter(run.env, run.directory, {.steps = 0, .minutes = 1e-9}).due(1));
  CHECK_FALSE(CheckpointWriter(run.env, run.directory, {.steps = 0, .minutes = 10.}).due(1));
  CHECK_FALSE(CheckpointWriter(run.env, run.directory, {.steps = 0, .minutes = 0.}).due(1));
}

TEST_CASE("Parameters of a restart: those of the checkpoint, changed only where nothing depends on them",
          "[output][checkpoint]")
{
  const sherd::test::TemporaryDirectory folder;
  const auto                            file       = folder.path() / "checkpoint.h5";
  auto                                  checkpoint = some_checkpoint(refined_plate());
  checkpoint.parameters                            = "fixed: {a: 3, b: 4}\nfree: {a: 5, b: 6}\n";
  on_root(MPI_COMM_WORLD, [&] { write_checkpoint(file, checkpoint); });
  const auto parameters = [&](std::vector<std::pair<std::string, std::string>> overrides) {
    CommandLine line;
    line.restart   = file.string();
    line.overrides = std::move(overrides);
    return read_parameters_of_run<Case>(Environment(MPI_COMM_WORLD, line), {"fixed"});
  };
  const auto alone = parameters({});
  CHECK((alone.fixed.a == 3. && alone.fixed.b == 4. && alone.free.a == 5. && alone.free.b == 6.));
  const auto changed = parameters({{"free.b", "7"}, {"fixed.a", "3"}});
  CHECK((changed.fixed.a == 3. && changed.free.a == 5. && changed.free.b == 7.));
  CHECK_THROWS_AS(parameters({{"fixed.b", "5"}}), InvalidParameter);
  CHECK_THROWS_WITH(parameters({{"fixed.b", "5"}}), Contains("fixed.b = 5") && Contains("written with 4"));
}
