#include <sherd/driver/run_case.h>

namespace sherd
{

void run_case(const Environment &env, Case prm)
{
  prm.resolve();
  std::string built;
  for (const auto &kernel : case_kernels())
    {
      if (kernel.degree == prm.surface.degree && kernel.spacedim == prm.surface.dimension)
        return kernel.run(env, prm);
      built += (built.empty() ? "" : ", ") + std::to_string(kernel.degree) + " in dimension " +
               std::to_string(kernel.spacedim);
    }
  throw InvalidParameter("surface.degree = " + std::to_string(prm.surface.degree) + " in dimension " +
                         std::to_string(prm.surface.dimension) + " is not built into this program, which has " +
                         (built.empty() ? "no kernel" : "degrees " + built) +
                         "; configure with -DSHERD_KERNELS=all for all of them");
}

} // namespace sherd
