#include <sherd/output/checkpoint_writer.h>

#include <fcntl.h>
#include <unistd.h>

#include <sherd/base/text_file.h>

namespace sherd
{
namespace fs = std::filesystem;

namespace
{

/// What has been written to a file or folder is on the disk, as far as the system can tell.
void synchronise(const fs::path &path)
{
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return;
  fsync(descriptor);
  close(descriptor);
}

/// Makes @p file, the @p age -th oldest checkpoint of a folder, the newest one.
void drop_newer(const fs::path &directory, int age)
{
  int n = 0;
  for (; fs::exists(directory / checkpoint_name(age + n)); ++n)
    fs::rename(directory / checkpoint_name(age + n), directory / checkpoint_name(n));
  for (int k = n; k < age; ++k)
    fs::remove(directory / checkpoint_name(k));
}

/// Makes room for a new checkpoint.h5: the others become one older, the newest keeps its first name as well.
void age_checkpoints(const fs::path &directory, int keep)
{
  const auto name = [&](int age) { return directory / checkpoint_name(age); };
  for (int age = keep; fs::exists(name(age)); ++age)
    fs::remove(name(age));
  if (keep == 1 || !fs::exists(name(0)))
    return;
  for (int age = keep - 1; age >= 2; --age)
    if (fs::exists(name(age - 1)))
      fs::rename(name(age - 1), name(age));
  auto second = name(1);
  second += ".part";
  fs::remove(second);
  std::error_code no_links;
  fs::create_hard_link(name(0), second, no_links);
  if (no_links)
    fs::copy_file(name(0), second);
  fs::rename(second, name(1));
  fs::remove(second);
}

template <class Task>
void with_file_errors(const Task &task)
{
  try
    {
      task();
    }
  catch (const fs::filesystem_error &error)
    {
      throw FileError("checkpoint " + error.path1().string() + ": " + error.code().message());
    }
}

} // namespace

CheckpointWriter::CheckpointWriter(const Environment &env, const OutputDirectory &directory,
                                   const CheckpointSettings &settings)
    : env_(env),
      directory_(directory.path()),
      settings_(settings),
      parameters_(read_text(env, directory.file("used.yaml")))
{
  on_root(env_.comm(), [&] {
    with_file_errors([&] {
      const auto &restart = env_.command_line().restart;
      for (int age = 1; restart && fs::exists(directory_ / checkpoint_name(age)); ++age)
        if (fs::path(*restart).filename() == checkpoint_name(age) &&
            fs::equivalent(*restart, directory_ / checkpoint_name(age)))
          {
            drop_newer(directory_, age);
            break;
          }
    });
  });
}

bool CheckpointWriter::due(int step) const
{
  const double minutes = std::chrono::duration<double>(Clock::now() - last_).count() / 60.;
  int          is_due =
      (settings_.steps > 0 && step % settings_.steps == 0) || (settings_.minutes > 0. && minutes >= settings_.minutes);
  MPI_Bcast(&is_due, 1, MPI_INT, 0, env_.comm());
  return is_due != 0;
}

void CheckpointWriter::put_in_place() const
{
  with_file_errors([&] {
    // Rows that a checkpoint knows of must not be lost with it still there.
    for (const auto &name : result_files())
      synchronise(directory_ / name);
    age_checkpoints(directory_, settings_.keep);
    fs::rename(part(), directory_ / checkpoint_name(0));
    synchronise(directory_);
  });
}

std::string CheckpointWriter::advice() const
{
  return "go on with " + env_.command_line().program + " --restart " + (directory_ / checkpoint_name(0)).string();
}

} // namespace sherd
