#include <sherd/base/version.h>

#include <Eigen/Core>
#include <Trilinos_version.h>

namespace sherd
{

std::vector<std::pair<std::string, std::string>> versions()
{
  const auto eigen = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                     std::to_string(EIGEN_MINOR_VERSION);
  return
  {
    {"sherd", version},
#if defined(__clang__)
        {"compiler", "clang " __clang_version__},
#else
        {"compiler", "gcc " __VERSION__},
#endif
        {"trilinos", TRILINOS_VERSION_STRING},
    {
      "eigen", eigen
    }
  };
}

} // namespace sherd
