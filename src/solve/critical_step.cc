#include <sherd/solve/critical_step.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <mpi.h>

namespace sherd
{

namespace
{

/// sum_j |A_ij| x_j
template <class Use>
void multiply_magnitudes(const Matrix &A, const Vector &x, const Use &use)
{
  const int n_fields = A.block_size();
  for (int a = 0; a < A.distribution().n_owned(); ++a)
    {
      const auto row = A.graph().row(a);
      for (int c = 0; c < n_fields; ++c)
        {
          const double *values = A.values().data() + A.row_start(a) + c * A.row_length(a);
          double        sum    = 0.;
          for (std::size_t k = 0; k < row.size(); ++k)
            for (int d = 0; d < n_fields; ++d)
              sum += std::abs(values[k * n_fields + d]) * x.local()[row[k] * n_fields + d];
          use(a * n_fields + c, sum);
        }
    }
}

} // namespace

Vector lumped_mass(const Matrix &mass)
{
  Vector ones(mass.shared_distribution(), mass.block_size());
  ones.fill(1.);
  Vector lumped = ones;
  multiply_magnitudes(mass, ones, [&](std::size_t i, double sum) { lumped.local()[i] = sum; });
  lumped.update_ghosts();
  return lumped;
}

double eigenvalue_bound(const Matrix &stiffness, const Vector &mass, std::span<const char> free)
{
  constexpr int n_iterations = 20;
  Vector        d(stiffness.shared_distribution(), stiffness.block_size());
  for (std::size_t i = 0; i < free.size(); ++i)
    d.local()[i] = free[i] ? 1. : 0.;
  Vector product = d;
  double bound   = std::numeric_limits<double>::infinity();
  for (int k = 0; k < n_iterations; ++k)
    {
      d.update_ghosts();
      double largest = 0.;
      multiply_magnitudes(stiffness, d, [&](std::size_t i, double sum) {
        if (free[i])
          {
            product.local()[i] = sum / mass.local()[i];
            const double ratio = product.local()[i] / d.local()[i];
            largest = std::isfinite(ratio) ? std::max(largest, ratio) : std::numeric_limits<double>::infinity();
          }
      });
      MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, stiffness.distribution().comm());
      if (!(largest > 0. && std::isfinite(largest)))
        return largest;
      bound = std::min(bound, largest);
      for (std::size_t i = 0; i < free.size(); ++i)
        if (free[i])
          d.local()[i] = .5 * (d.local()[i] + product.local()[i] / largest);
    }
  return bound;
}

} // namespace sherd
