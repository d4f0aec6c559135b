#pragma once

#include <span>
#include <vector>

#include <sherd/algebra/matrix.h>
#include <sherd/algebra/vector.h>
#include <sherd/base/parameter_section.h>

namespace sherd
{

/// Whether the modes that were found are counted.
enum class ModeCount
{
  check, ///< one more factorisation proves that no mode was missed
  none
};

struct EigenSettings
{
  int    n_modes      = 6;
  double shift        = 0.;   ///< modes above it are found; negative for a body without supports
  double tolerance    = 1e-9; ///< of the modes of the inverted problem
  int    block_size   = 4;    ///< vectors iterated together; not below the largest multiplicity expected
  int    max_restarts = 50;
  /// Sylvester's law of inertia, applied in the last gap wider than 1e-4 (of the distance to the shift) between the
  /// modes.
  ModeCount count = ModeCount::check;

  void declare(ParameterSection &section)
  {
    section.value("n_modes", n_modes, range::at_least(1), "number of modes");
    section.value("shift", shift, "eigenvalue", range::any(),
                  "eigenvalues above it are found; negative for a body without supports");
    section.value("tolerance", tolerance, "-", range::open(0., 1.), "residual of the inverted problem, relative");
    section.value("block_size", block_size, range::at_least(2), "vectors iterated together");
    section.value("max_restarts", max_restarts, range::non_negative(), "restarts of the Krylov space");
    section.choice("count", count, {{"check", ModeCount::check}, {"none", ModeCount::none}},
                   "whether one more factorisation proves that no mode was missed");
  }
};

/// Modes of K v = lambda M v. Signs of the vectors, and their basis within a multiple eigenvalue, are arbitrary.
struct EigenPairs
{
  std::vector<double> values;  ///< ascending, shape=(n_modes)
  std::vector<Vector> vectors; ///< v_i . M v_j = delta_ij, zero where fixed; ghosts are up to date
  /// |K v - lambda M v| / (|K v| + (|lambda| + |shift|) |M v|), Euclidean norms over the free unknowns. Not below
  /// rounding times the condition number of K.
  std::vector<double> residuals;
  /// Number of negative pivots of K - shift M: if M is positive definite, the number of eigenvalues below the shift; 0
  /// tells that the modes are the lowest there are (and for shift = 0 that K is positive definite).
  int n_below_shift = 0;
};

/// The n_modes lowest eigenvalues above the shift of K v = lambda M v with K symmetric, possibly indefinite, and M
/// symmetric positive semi-definite: shift and invert, block Krylov-Schur on (K - shift M)^-1 M in the inner product
/// of M (Anasazi), with the factors L D L^T of MUMPS. Every eigenvalue counts as often as its multiplicity. Modes that
/// M does not see (infinite eigenvalues) are not among them. Choose the shift below the modes of interest; EigenPairs::
/// n_below_shift tells how many are missed.
///
/// @p fixed marks owned unknowns, shape=(n_owned * block_size), that are zero in every mode: supports, and unknowns
/// without stiffness and mass. Their rows and columns have no influence. Results do not depend on the number of ranks
/// beyond rounding. Collective; the matrices stay as they are.
///
/// Throws, on all ranks, DimensionMismatch if matrices (same graph) and @p fixed do not fit together; InvalidParameter
/// if a setting is out of range or if fewer than n_modes + 3 * block_size unknowns are free; NoConvergence if the shift
/// is an eigenvalue to rounding (of a body without supports 0 is one: choose a negative shift of the size of the first
/// eigenvalue sought), if too few modes converge or lie above the shift, or if the count finds that modes were missed.
EigenPairs lowest_eigenpairs(const Matrix &stiffness, const Matrix &mass, std::span<const char> fixed,
                             const EigenSettings &settings);

} // namespace sherd
