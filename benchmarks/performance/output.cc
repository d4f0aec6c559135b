// Output of a plate in megabytes a second of the file written: frames for ParaView, fields as splines, checkpoints.
// Processor time leaves out waiting for the disk, so these are wall times.
//
// Run:  OMP_NUM_THREADS=1 build/benchmarks/output          [--benchmark_format=json]
#include "plate.h"

#include <filesystem>

#include <unistd.h>

#include <sherd/output/checkpoint.h>
#include <sherd/output/fields_file.h>
#include <sherd/output/frames.h>

using namespace sherd;
using namespace sherd::performance;
namespace fs = std::filesystem;

namespace
{

class TemporaryFolder
{
public:
  TemporaryFolder() : path_(fs::temp_directory_path() / ("sherd-output-" + std::to_string(getpid())))
  {
    fs::create_directories(path_);
  }
  ~TemporaryFolder() { fs::remove_all(path_); }

  const fs::path &path() const { return path_; }

private:
  fs::path path_;
};

void count_file(benchmark::State &run, double bytes, int n_points)
{
  run.counters["MB"]           = bytes * 1e-6;
  run.counters["MB/s"]         = rate(bytes * 1e-6);
  run.counters["us_per_point"] = time_by(n_points * 1e-6);
}

/// Argument of all: elements along the plate.
void frame(benchmark::State &run)
{
  const TemporaryFolder folder;
  const Plate           plate(static_cast<int>(run.range(0)));
  const auto            fields = snapshot(plate.state);
  const auto            file   = folder.path() / "frame.vtu";
  for (auto _ : run)
    write_frame(file, plate.surface, fields);
  count_file(run, fs::file_size(file), plate.surface.n_control_points());
}
BENCHMARK(frame)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The first frame with its mesh, in a new file.
void fields(benchmark::State &run)
{
  const TemporaryFolder folder;
  const Plate           plate(static_cast<int>(run.range(0)));
  const auto            values = snapshot(plate.state);
  for (auto _ : run)
    FieldsFile(folder.path(), 2, 2).write(plate.surface, values);
  count_file(run, fs::file_size(folder.path() / "fields.h5"), plate.surface.n_control_points());
}
BENCHMARK(fields)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

/// On the disk at the end of each.
void checkpoint(benchmark::State &run)
{
  const TemporaryFolder  folder;
  const Plate            plate(static_cast<int>(run.range(0)));
  const Checkpoint<2, 2> content{plate.surface, gather(plate.state, plate.space), {}, {}, {}};
  const auto             file = folder.path() / "checkpoint.h5";
  for (auto _ : run)
    write_checkpoint(file, content);
  count_file(run, fs::file_size(file), plate.surface.n_control_points());
}
BENCHMARK(checkpoint)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

void read(benchmark::State &run)
{
  const TemporaryFolder folder;
  const Plate           plate(static_cast<int>(run.range(0)));
  const auto            file = folder.path() / "checkpoint.h5";
  write_checkpoint(file, Checkpoint<2, 2>{plate.surface, gather(plate.state, plate.space), {}, {}, {}});
  for (auto _ : run)
    benchmark::DoNotOptimize(read_checkpoint<2, 2>(world(), file));
  count_file(run, fs::file_size(file), plate.surface.n_control_points());
}
BENCHMARK(read)->Arg(200)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

int main(int argc, char **argv)
{
  return run_benchmarks(argc, argv);
}
