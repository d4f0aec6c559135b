#pragma once

#include <memory>
#include <span>
#include <vector>

#include <sherd/algebra/distribution.h>

namespace sherd
{

/// Distributed vector with a block of block_size values for each local control point, ghosts included. Component c of
/// local control point a is entry a * block_size + c of local(). Copies are deep; they share the distribution.
class Vector
{
public:
  /// All values zero.
  Vector(std::shared_ptr<const Distribution> distribution, int block_size);

  const Distribution                        &distribution() const { return *distribution_; }
  const std::shared_ptr<const Distribution> &shared_distribution() const { return distribution_; }
  int                                        block_size() const { return block_size_; }

  /// Owned values, then ghosts, shape=(n_local * block_size).
  std::span<double>       local() { return values_; }
  std::span<const double> local() const { return values_; }

  /// Owned values only, shape=(n_owned * block_size).
  std::span<double>       owned() { return local().first(n_owned_values()); }
  std::span<const double> owned() const { return local().first(n_owned_values()); }

  /// Brings the owners' values to their copies. Collective.
  void update_ghosts();

  /// Sets all local values, ghosts included.
  void fill(double value);

private:
  std::size_t n_owned_values() const { return static_cast<std::size_t>(distribution_->n_owned()) * block_size_; }

  std::shared_ptr<const Distribution> distribution_;
  int                                 block_size_;
  std::vector<double>                 values_;
};

/// Sum of x_i y_i over all ranks, each control point counted once. Collective.
double dot(const Vector &x, const Vector &y);

/// Euclidean norm. Collective.
double norm(const Vector &x);

/// y += alpha x on all local values, ghosts included.
void axpy(double alpha, const Vector &x, Vector &y);

/// x *= alpha on all local values, ghosts included.
void scale(double alpha, Vector &x);

/// All values on every rank: component c of global control point id at id * block_size + c, shape=(n_global *
/// block_size). Collective.
std::vector<double> gather(const Vector &x);

/// Takes this rank's part, ghosts included, out of values in global numbering, the inverse of gather. Throws
/// DimensionMismatch.
void scatter(std::span<const double> values, Vector &x);

} // namespace sherd
