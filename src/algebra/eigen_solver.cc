#include <sherd/algebra/eigen_solver.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziTpetraAdapter.hpp>
#include <Eigen/Dense>

#include "equilibration.h"
#include "exchange.h"
#include "factorisation.h"
#include "function_operator.h"
#include "tpetra_types.h"
#include <sherd/base/collective.h>
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

using Teuchos::RCP;
using Teuchos::rcp;
using tpetra::MultiVector;

template <class... Parts>
std::string concatenate(const Parts &...parts)
{
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

template <class... Parts>
std::string text(const Parts &...parts)
{
  return concatenate("eigen-solver: ", parts...);
}

void check(const Matrix &stiffness, const Matrix &mass, std::span<const char> fixed, const EigenSettings &settings)
{
  const auto &graph = stiffness.graph();
  if (stiffness.block_size() != mass.block_size() || graph.offsets != mass.graph().offsets ||
      graph.columns != mass.graph().columns)
    throw DimensionMismatch(text("stiffness and mass need the same graph and block size"));
  if (const auto n = static_cast<std::size_t>(graph.n_rows()) * stiffness.block_size(); fixed.size() != n)
    throw DimensionMismatch(
        text(fixed.size(), " marks of fixed unknowns given, expected one for each of ", n, " owned unknowns"));
  if (settings.n_modes < 1)
    throw InvalidParameter(text("n_modes = ", settings.n_modes, ", expected at least 1"));
  if (settings.block_size < 2)
    throw InvalidParameter(text("block_size = ", settings.block_size, ", expected at least 2"));
  if (settings.max_restarts < 0)
    throw InvalidParameter(text("max_restarts = ", settings.max_restarts, ", expected at least 0"));
  if (!(settings.tolerance > 0. && settings.tolerance < 1.))
    throw InvalidParameter(text("tolerance = ", settings.tolerance, ", expected a value in (0, 1)"));
  if (!std::isfinite(settings.shift))
    throw InvalidParameter(text("shift = ", settings.shift, ", expected a finite value"));
}

/// A value in [-1, 1) that depends on the two numbers alone.
double scattered(std::int64_t id, std::size_t column)
{
  auto bits = static_cast<std::uint64_t>(id) * 0x9e3779b97f4a7c15ULL + column * 0xd1b54a32d192ed03ULL + 1;
  for (const int shift : {30, 27, 31})
    bits = (bits ^ (bits >> shift)) * 0xbf58476d1ce4e5b9ULL;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1.;
}

double norm(std::span<const double> x, MPI_Comm comm)
{
  double sum = 0.;
  for (const double value : x)
    sum += value * value;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return std::sqrt(sum);
}

/// The pencil (K, M) on the free unknowns: vectors there have one value for each owned unknown that is not fixed.
class Pencil
{
public:
  Pencil(const Matrix &stiffness, const Matrix &mass, std::span<const char> fixed)
      : stiffness_(stiffness),
        mass_(mass),
        mask_(static_cast<std::size_t>(stiffness.distribution().n_local()) * stiffness.block_size(), 0.),
        local_(mask_.size()),
        owned_(fixed.size())
  {
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (fixed[i] == 0)
        {
          mask_[i] = 1.;
          free_.push_back(i);
        }
    update_ghost_values(distribution(), mask_, stiffness.block_size());
    n_global_ = static_cast<std::int64_t>(free_.size());
    MPI_Allreduce(MPI_IN_PLACE, &n_global_, 1, MPI_INT64_T, MPI_SUM, distribution().comm());
  }

  const Distribution &distribution() const { return stiffness_.distribution(); }
  std::size_t         n_free() const { return free_.size(); }
  std::int64_t        n_free_global() const { return n_global_; }

  /// Number of a free unknown, the same on any number of ranks.
  std::int64_t id(std::size_t k) const
  {
    const int block_size = stiffness_.block_size();
    return distribution().global(static_cast<int>(free_[k] / block_size)) * block_size +
           static_cast<std::int64_t>(free_[k] % block_size);
  }

  void multiply_stiffness(std::span<const double> x, std::span<double> y) { multiply(stiffness_, x, y); }
  void multiply_mass(std::span<const double> x, std::span<double> y) { multiply(mass_, x, y); }

  /// K - shift M with rows and columns of the identity where fixed.
  Matrix shifted(double shift) const
  {
    Matrix      result     = stiffness_;
    const auto &graph      = result.graph();
    const int   block_size = result.block_size();
    std::size_t place      = 0;
    for (int A = 0; A < graph.n_rows(); ++A)
      for (int c = 0; c < block_size; ++c)
        for (const int B : graph.row(A))
          for (int d = 0; d < block_size; ++d, ++place)
            {
              const auto row    = static_cast<std::size_t>(A) * block_size + c;
              const auto column = static_cast<std::size_t>(B) * block_size + d;
              double    &value  = result.values()[place];
              if (mask_[row] == 0. || mask_[column] == 0.)
                value = row == column ? 1. : 0.;
              else
                value -= shift * mass_.values()[place];
            }
    return result;
  }

  /// All owned unknowns of a vector on the free ones, zero where fixed.
  void expand(std::span<const double> x, std::span<double> owned) const
  {
    std::fill(owned.begin(), owned.end(), 0.);
    for (std::size_t k = 0; k < free_.size(); ++k)
      owned[free_[k]] = x[k];
  }

  void restrict(std::span<const double> owned, std::span<double> x) const
  {
    for (std::size_t k = 0; k < free_.size(); ++k)
      x[k] = owned[free_[k]];
  }

private:
  void multiply(const Matrix &matrix, std::span<const double> x, std::span<double> y)
  {
    expand(x, std::span(local_).first(owned_.size()));
    update_ghost_values(distribution(), local_, matrix.block_size());
    matrix.multiply(local_, owned_);
    restrict(owned_, y);
  }

  const Matrix            &stiffness_, &mass_;
  std::vector<double>      mask_; ///< 1 where free, with ghosts
  std::vector<std::size_t> free_; ///< owned unknowns
  std::int64_t             n_global_ = 0;
  std::vector<double>      local_, owned_;
};

/// (K - shift M)^-1 on the free unknowns.
class ShiftedInverse
{
public:
  ShiftedInverse(const Pencil &pencil, std::size_t n_owned)
      : pencil_(pencil), factors_(make_symmetric_mumps()), in_(n_owned), out_(n_owned)
  {
  }

  /// Factors; the symbolic phase is made once.
  void factor(double shift)
  {
    auto matrix = pencil_.shifted(shift);
    try
      {
        scaling_ = equilibrate(matrix).scaling;
        factors_->compute(matrix);
      }
    catch (const NoConvergence &error)
      {
        refuse(shift, error.what());
      }
    const auto block_size = static_cast<std::size_t>(matrix.block_size());
    for (std::size_t i = 0; i < in_.size(); ++i)
      in_[i] = scattered(matrix.distribution().global(static_cast<int>(i / block_size)), i % block_size);
    factors_->apply(in_, out_);
    const auto   comm          = pencil_.distribution().comm();
    const double amplification = norm(out_, comm) / norm(in_, comm);
    if (!(amplification < singular))
      refuse(shift, concatenate("its inverse makes vectors ", amplification, " times as large"));
  }

  int n_negative() const { return factors_->n_negative(); }

  void apply(std::span<const double> x, std::span<double> y)
  {
    pencil_.expand(x, in_);
    for (std::size_t i = 0; i < in_.size(); ++i)
      in_[i] *= scaling_[i];
    factors_->apply(in_, out_);
    for (std::size_t i = 0; i < out_.size(); ++i)
      out_[i] *= scaling_[i];
    pencil_.restrict(out_, y);
  }

private:
  /// An equilibrated matrix whose inverse makes a vector larger by this factor is singular to rounding.
  static constexpr double singular = 1e13;

  [[noreturn]] static void refuse(double shift, const std::string &reason)
  {
    throw NoConvergence(text("no factors of K - shift M at shift = ", shift,
                             "; if the shift is an eigenvalue, as 0 is for a body without supports, choose another "
                             "one, negative and of the size of the first eigenvalue sought: ",
                             reason));
  }

  const Pencil                           &pencil_;
  std::unique_ptr<SymmetricFactorisation> factors_;
  std::vector<double>                     scaling_, in_, out_;
};

/// Largest eigenvectors of the operator in the inner product of M. Throws NoConvergence.
RCP<MultiVector> largest(const RCP<tpetra::Operator> &inverse, const RCP<tpetra::Operator> &mass,
                         const RCP<MultiVector> &start, int n_wanted, const EigenSettings &settings)
{
  const int  block    = settings.block_size;
  const auto n        = static_cast<std::int64_t>(start->getGlobalLength());
  const auto n_blocks = std::min<std::int64_t>((2 * n_wanted + 20) / block + 2, n / block - 1);

  Teuchos::ParameterList parameters;
  parameters.set("Which", "LR");
  parameters.set("Block Size", block);
  parameters.set("Num Blocks", static_cast<int>(n_blocks));
  parameters.set("Maximum Restarts", settings.max_restarts);
  parameters.set("Step Size", 1);
  parameters.set("Convergence Tolerance", settings.tolerance);
  parameters.set("Relative Convergence Tolerance", true);
  parameters.set("Verbosity", 0);

  int n_converged = 0;
  try
    {
      using Problem      = Anasazi::BasicEigenproblem<double, MultiVector, tpetra::Operator>;
      const auto problem = rcp(new Problem(inverse, mass, start));
      problem->setHermitian(true);
      problem->setNEV(n_wanted);
      problem->setProblem();
      Anasazi::BlockKrylovSchurSolMgr<double, MultiVector, tpetra::Operator> solver(problem, parameters);
      const auto                                                             outcome  = solver.solve();
      const auto                                                            &solution = problem->getSolution();
      if (outcome == Anasazi::Converged && solution.numVecs >= n_wanted)
        return solution.Evecs;
      n_converged = solution.numVecs;
    }
  catch (const std::exception &error)
    {
      throw NoConvergence(text("block Krylov-Schur broke down: ", tpetra::last_line(error.what()),
                               "; the mass may see fewer unknowns than modes are sought"));
    }
  throw NoConvergence(text(n_converged, " of ", n_wanted, " modes (with guards) converged to ", settings.tolerance,
                           " within ", settings.max_restarts,
                           " restarts; try more restarts or a shift closer to the modes"));
}

/// x^T y over all ranks.
Eigen::MatrixXd products(const MultiVector &x, const MultiVector &y, MPI_Comm comm)
{
  const auto n_x = static_cast<Eigen::Index>(x.getNumVectors()), n_y = static_cast<Eigen::Index>(y.getNumVectors());
  Eigen::MatrixXd result(n_x, n_y);
  for (Eigen::Index i = 0; i < n_x; ++i)
    for (Eigen::Index j = 0; j < n_y; ++j)
      {
        const auto a = x.getData(i), b = y.getData(j);
        double     sum = 0.;
        for (Teuchos::Ordinal k = 0; k < a.size(); ++k)
          sum += a[k] * b[k];
        result(i, j) = sum;
      }
  MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE, MPI_SUM, comm);
  return result;
}

/// Throws NoConvergence unless as many eigenvalues as were found lie between the shift and a place above some of them.
/// @p values have one more than n_modes.
void count(ShiftedInverse &inverse, std::span<const double> values, const EigenSettings &settings, int n_below)
{
  constexpr double distinct = 1e-4; // relative distance of eigenvalues between which a shift is not too close to either
  for (auto n = static_cast<int>(values.size()) - 1; n > 0; --n)
    {
      const double below = values[n - 1], above = values[n];
      if (above - below < distinct * (above - settings.shift))
        continue;
      const double place = 0.5 * (below + above);
      inverse.factor(place);
      if (const int n_found = inverse.n_negative() - n_below; n_found != n)
        throw NoConvergence(text(n_found, " eigenvalues lie between the shift ", settings.shift, " and ", place,
                                 ", but ", n, " were found; try a larger block_size (now ", settings.block_size,
                                 ") or a smaller tolerance"));
      return;
    }
}

} // namespace

EigenPairs lowest_eigenpairs(const Matrix &stiffness, const Matrix &mass, std::span<const char> fixed,
                             const EigenSettings &settings)
{
  const auto comm = stiffness.distribution().comm();
  collectively(comm, [&] { check(stiffness, mass, fixed, settings); });
  Pencil     pencil(stiffness, mass, fixed);
  const int  n_modes = settings.n_modes, n_wanted = n_modes + 1;
  const auto n_needed = n_modes + 3 * settings.block_size;
  if (pencil.n_free_global() < n_needed)
    throw InvalidParameter(text("n_modes = ", n_modes, " and block_size = ", settings.block_size, " need ", n_needed,
                                " free unknowns, but there are ", pencil.n_free_global()));

  EigenPairs     result;
  ShiftedInverse inverse(pencil, fixed.size());
  inverse.factor(settings.shift);
  result.n_below_shift = inverse.n_negative();

  const auto map = rcp(new tpetra::Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), pencil.n_free(), 0,
                                       tpetra::communicator(comm)));
  std::vector<double> work(pencil.n_free());
  const auto shift_and_invert = tpetra::as_operator(map, [&](std::span<const double> in, std::span<double> out) {
    pencil.multiply_mass(in, work);
    inverse.apply(work, out);
  });
  const auto multiply_mass    = tpetra::as_operator(
         map, [&](std::span<const double> in, std::span<double> out) { pencil.multiply_mass(in, out); });

  // The start has no part that M does not see, so the Krylov space has none.
  const auto random = rcp(new MultiVector(map, settings.block_size)),
             start  = rcp(new MultiVector(map, settings.block_size));
  for (std::size_t column = 0; column < random->getNumVectors(); ++column)
    {
      const auto values = random->getDataNonConst(column);
      for (std::size_t k = 0; k < pencil.n_free(); ++k)
        values[k] = scattered(pencil.id(k), column);
    }
  shift_and_invert->apply(*random, *start);
  const auto ritz = largest(shift_and_invert, multiply_mass, start, n_wanted, settings);

  // One more application makes the residuals of K v = lambda M v as small as those of the inverted problem, which weigh
  // high frequencies less. Within its span: Rayleigh and Ritz.
  const auto  n_found = static_cast<int>(ritz->getNumVectors());
  MultiVector applied(map, n_found), mass_ritz(map, n_found);
  shift_and_invert->apply(*ritz, applied);
  multiply_mass->apply(*ritz, mass_ritz);
  const Eigen::MatrixXd H = products(mass_ritz, applied, comm), G = products(mass_ritz, *ritz, comm);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(0.5 * (H + H.transpose()),
                                                                        0.5 * (G + G.transpose()));
  if (dense.info() != Eigen::Success)
    throw NoConvergence(text("the modes are linearly dependent; the mass may be indefinite"));
  std::vector<double> values;
  for (int k = 0; k < n_wanted; ++k)
    {
      const double theta = dense.eigenvalues()[n_found - 1 - k];
      if (theta <= 0.)
        throw NoConvergence(text(k, " eigenvalues lie above the shift ", settings.shift, ", ", n_modes,
                                 " and one more to count them are sought; choose a lower shift or fewer modes"));
      values.push_back(settings.shift + 1. / theta);
    }

  std::vector<double> v(pencil.n_free()), mass_v(v.size()), stiffness_v(v.size());
  for (int k = 0; k < n_modes; ++k)
    {
      std::fill(v.begin(), v.end(), 0.);
      for (int j = 0; j < n_found; ++j)
        {
          const auto   column      = applied.getData(j);
          const double coefficient = dense.eigenvectors()(j, n_found - 1 - k);
          for (std::size_t i = 0; i < v.size(); ++i)
            v[i] += coefficient * column[i];
        }
      pencil.multiply_mass(v, mass_v);
      double mass_norm = 0.;
      for (std::size_t i = 0; i < v.size(); ++i)
        mass_norm += v[i] * mass_v[i];
      MPI_Allreduce(MPI_IN_PLACE, &mass_norm, 1, MPI_DOUBLE, MPI_SUM, comm);
      mass_norm = std::sqrt(mass_norm);
      for (std::size_t i = 0; i < v.size(); ++i)
        {
          v[i] /= mass_norm;
          mass_v[i] /= mass_norm;
        }
      pencil.multiply_stiffness(v, stiffness_v);
      const double scale =
          norm(stiffness_v, comm) + (std::abs(values[k]) + std::abs(settings.shift)) * norm(mass_v, comm);
      for (std::size_t i = 0; i < v.size(); ++i)
        stiffness_v[i] -= values[k] * mass_v[i];
      result.residuals.push_back(norm(stiffness_v, comm) / scale);

      Vector vector(stiffness.shared_distribution(), stiffness.block_size());
      pencil.expand(v, vector.owned());
      vector.update_ghosts();
      result.vectors.push_back(std::move(vector));
    }
  if (settings.count == ModeCount::check)
    count(inverse, values, settings, result.n_below_shift);
  values.pop_back();
  result.values = std::move(values);
  return result;
}

} // namespace sherd
