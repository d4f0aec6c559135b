#pragma once

#include <span>
#include <string>

#include "factorisation.h"

namespace sherd
{

struct GmresLimits
{
  double tolerance; ///< of the residual relative to the right-hand side
  int    max_iterations, restart;
};

struct GmresResult
{
  int         iterations = 0;
  std::string failure; ///< why it broke down, empty if it did not
};

/// Improves z = 0 towards A z = r by restarted GMRES, preconditioned from the right. Collective.
GmresResult gmres(const Matrix &matrix, Factorisation &factors, std::span<const double> r, std::span<double> z,
                  const GmresLimits &limits);

} // namespace sherd
