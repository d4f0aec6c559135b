#pragma once

#include <memory>
#include <span>

#include <sherd/algebra/matrix.h>

namespace sherd
{

/// Complete or incomplete factors of a distributed matrix. Vectors are the owned values of a rank.
class Factorisation
{
public:
  virtual ~Factorisation() = default;

  /// Numeric phase, with the symbolic phase before it if the graph is another one than last time. Collective. Throws
  /// NoConvergence on all ranks if the factors break down.
  virtual void compute(const Matrix &matrix) = 0;

  /// z = M^-1 r with the factors M. Collective.
  virtual void apply(std::span<const double> r, std::span<double> z) = 0;

  /// Whether M is A to rounding, so that one application solves.
  virtual bool is_complete() const { return false; }
};

/// Factors of small dense blocks (algebra/block_ilu.h) of each rank's rows and @p overlap layers of its neighbours',
/// put together by restricted additive Schwarz.
std::unique_ptr<Factorisation> make_point_block_ilu(int fill_level, int overlap);

/// RILUK of Ifpack2, on several ranks inside its additive Schwarz preconditioner.
std::unique_ptr<Factorisation> make_ifpack2_ilu(int fill_level, int overlap);

/// MUMPS, unsymmetric (L U), ordered by nested dissection of the graph of control points (METIS). compute() throws
/// NoConvergence if pivots vanish to rounding: such factors would solve nothing, or anything.
std::unique_ptr<Factorisation> make_mumps();

/// Factors of a symmetric matrix that tell its inertia.
class SymmetricFactorisation : public Factorisation
{
public:
  /// Number of negative eigenvalues of the matrix (Sylvester's law of inertia).
  virtual int n_negative() const = 0;
};

/// The same for symmetric, possibly indefinite matrices (L D L^T); of each pair of entries it takes the one whose
/// global row is not larger than its column.
std::unique_ptr<SymmetricFactorisation> make_symmetric_mumps();

} // namespace sherd
