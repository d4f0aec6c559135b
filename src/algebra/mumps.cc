#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <dmumps_c.h>
#include <metis.h>

#include "factorisation.h"
#include <sherd/base/collective.h>

namespace sherd
{

namespace
{

enum Job : MUMPS_INT
{
  initialise = -1,
  finish     = -2,
  analyse    = 1,
  factorise  = 2,
  substitute = 3
};

/// What it means that @p n_missing of @p n pivots are zero.
std::string singular(MUMPS_INT n_missing, MUMPS_INT n)
{
  return "the matrix is singular, " + std::to_string(n_missing) + " of its " + std::to_string(n) +
         " pivots are zero to rounding; a static body may lack supports, or the load is at a limit or bifurcation "
         "point: add supports, or take another step";
}

std::string explain(const DMUMPS_STRUC_C &mumps)
{
  const auto        code = mumps.infog[0], detail = mumps.infog[1];
  const std::string number = "MUMPS error " + std::to_string(code) + " (" + std::to_string(detail) + "): ";
  switch (code)
    {
    case -5:
    case -7:
    case -13:
      return number + "out of memory; use an incomplete factorisation, more ranks or a coarser mesh";
    case -6:
      return number + "the matrix is structurally singular, of rank " + std::to_string(detail);
    case -8:
    case -9:
      return number + "the factors need more memory than was estimated, several times over";
    case -10:
      return number + singular(mumps.n - detail, mumps.n);
    case -17:
    case -20:
      return number + "a communication buffer is too small";
    default:
      return number + "see INFOG(1) in the manual of MUMPS";
    }
}

/// Numbers of all ranks, one rank after the other, on rank 0; empty elsewhere.
template <class Number>
std::vector<Number> gather_on_root(MPI_Comm comm, MPI_Datatype type, std::span<const Number> numbers)
{
  int rank, n_ranks;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &n_ranks);
  const int        count = static_cast<int>(numbers.size());
  std::vector<int> counts(n_ranks), offsets(n_ranks);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  std::vector<Number> result(rank == 0 ? offsets.back() + counts.back() : 0);
  MPI_Gatherv(numbers.data(), count, type, result.data(), counts.data(), offsets.data(), type, 0, comm);
  return result;
}

/// Position of each vertex in a nested dissection order. The vertex ids[i] has lengths[i] neighbours, which follow each
/// other in columns.
std::vector<idx_t> dissect(std::span<const std::int64_t> ids, std::span<const int> lengths,
                           std::span<const std::int64_t> columns)
{
  std::vector<std::vector<idx_t>> neighbours(ids.size());
  for (std::size_t i = 0, place = 0; i < ids.size(); ++i)
    for (int k = 0; k < lengths[i]; ++k, ++place)
      if (columns[place] != ids[i])
        {
          neighbours[ids[i]].push_back(static_cast<idx_t>(columns[place]));
          neighbours[columns[place]].push_back(static_cast<idx_t>(ids[i]));
        }
  std::vector<idx_t> offsets = {0}, flat;
  for (auto &row : neighbours)
    {
      std::sort(row.begin(), row.end());
      flat.insert(flat.end(), row.begin(), std::unique(row.begin(), row.end()));
      offsets.push_back(static_cast<idx_t>(flat.size()));
    }

  idx_t              n = static_cast<idx_t>(ids.size());
  std::vector<idx_t> order(n), position(n);
  std::iota(position.begin(), position.end(), 0);
  if (flat.empty())
    return position;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_NodeND(&n, offsets.data(), flat.data(), nullptr, options, order.data(), position.data()) != METIS_OK)
    throw Error("MUMPS: METIS found no order for " + std::to_string(n) + " control points");
  return position;
}

/// A pivot below this fraction of the norm of the equilibrated matrix is zero to rounding.
constexpr double zero_pivot = 1e-15;

enum class Symmetry : MUMPS_INT
{
  none    = 0,
  general = 2 ///< symmetric, not necessarily definite
};

class Mumps final : public SymmetricFactorisation
{
public:
  explicit Mumps(Symmetry symmetry) : symmetry_(symmetry) {}
  ~Mumps() override { end(); }
  Mumps(const Mumps &)            = delete;
  Mumps &operator=(const Mumps &) = delete;

  void compute(const Matrix &matrix) override
  {
    if (matrix.shared_graph() != graph_ || matrix.block_size() != block_size_)
      begin(matrix);
    mumps_.a_loc = entries(matrix);
    for (int enlarged = 0;; ++enlarged)
      {
        mumps_.job = factorise;
        dmumps_c(&mumps_);
        const bool too_small = mumps_.infog[0] == -8 || mumps_.infog[0] == -9;
        if (!too_small || enlarged == 4)
          break;
        mumps_.icntl[13] *= 2;
      }
    check();
    if (const auto n_zero = mumps_.infog[27]; n_zero > 0)
      throw NoConvergence("MUMPS: " + singular(n_zero, mumps_.n));
  }

  void apply(std::span<const double> r, std::span<double> z) override
  {
    const auto comm      = distribution_->comm();
    const auto collected = gather_on_root<double>(comm, MPI_DOUBLE, r);
    for (std::size_t i = 0; i < ids_.size(); ++i)
      std::copy_n(collected.data() + i * block_size_, block_size_, rhs_.data() + ids_[i] * block_size_);
    mumps_.rhs = rhs_.data();
    mumps_.job = substitute;
    dmumps_c(&mumps_);
    check();

    std::vector<double> ordered(collected.size());
    for (std::size_t i = 0; i < ids_.size(); ++i)
      std::copy_n(rhs_.data() + ids_[i] * block_size_, block_size_, ordered.data() + i * block_size_);
    MPI_Scatterv(ordered.data(), counts_.data(), offsets_.data(), MPI_DOUBLE, z.data(), static_cast<int>(z.size()),
                 MPI_DOUBLE, 0, comm);
  }

  bool is_complete() const override { return true; }
  int  n_negative() const override { return static_cast<int>(mumps_.infog[11]); }

private:
  /// Starts an instance for the graph of @p matrix and analyses it.
  void begin(const Matrix &matrix)
  {
    end();
    distribution_ = matrix.shared_distribution();
    block_size_   = matrix.block_size();

    mumps_              = {};
    mumps_.par          = 1;
    mumps_.sym          = static_cast<MUMPS_INT>(symmetry_);
    mumps_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(distribution_->comm()));
    mumps_.job          = initialise;
    dmumps_c(&mumps_);
    check();
    graph_ = matrix.shared_graph();

    const auto icntl = [this](int number) -> MUMPS_INT & { return mumps_.icntl[number - 1]; };
    for (const int stream : {1, 2, 3})
      icntl(stream) = -1;
    icntl(4)       = 0;  // silent
    icntl(6)       = 0;  // no permutation for a zero-free diagonal
    icntl(7)       = 1;  // order given in perm_in
    icntl(8)       = 0;  // the matrix is equilibrated
    icntl(10)      = 0;  // no iterative refinement
    icntl(13)      = 1;  // no ScaLAPACK for the last front: it finds no zero pivots and counts no negative ones
    icntl(14)      = 30; // per cent of memory more than estimated
    icntl(18)      = 3;  // entries given by the ranks that have them
    icntl(20)      = 0;  // right-hand side on rank 0
    icntl(21)      = 0;  // solution on rank 0
    icntl(24)      = 1;  // find zero pivots
    icntl(28)      = 1;  // analysis on rank 0
    mumps_.cntl[2] = zero_pivot;

    number_entries(matrix);
    collect_order(matrix.graph());
    mumps_.n       = static_cast<MUMPS_INT>(distribution_->n_global() * block_size_);
    mumps_.nnz_loc = static_cast<MUMPS_INT8>(rows_.size());
    mumps_.irn_loc = rows_.data();
    mumps_.jcn_loc = columns_.data();
    mumps_.perm_in = order_.data();
    mumps_.job     = analyse;
    dmumps_c(&mumps_);
    check();
  }

  void end()
  {
    if (!graph_)
      return;
    graph_.reset();
    mumps_.job = finish;
    dmumps_c(&mumps_);
  }

  void check() const
  {
    if (mumps_.infog[0] < 0)
      throw NoConvergence(explain(mumps_));
  }

  /// Row and column, from 1, of every entry of Matrix::values() that MUMPS is given.
  void number_entries(const Matrix &matrix)
  {
    const auto &graph = matrix.graph();
    rows_.clear();
    columns_.clear();
    kept_.clear();
    rows_.reserve(matrix.values().size());
    columns_.reserve(matrix.values().size());
    std::size_t place = 0;
    for (int A = 0; A < graph.n_rows(); ++A)
      for (int c = 0; c < block_size_; ++c)
        for (const int B : graph.row(A))
          for (int d = 0; d < block_size_; ++d, ++place)
            {
              const auto row    = distribution_->global(A) * block_size_ + c + 1;
              const auto column = distribution_->global(B) * block_size_ + d + 1;
              if (symmetry_ == Symmetry::general && row > column)
                continue;
              rows_.push_back(static_cast<MUMPS_INT>(row));
              columns_.push_back(static_cast<MUMPS_INT>(column));
              if (symmetry_ == Symmetry::general)
                kept_.push_back(place);
            }
  }

  /// The values that belong to rows_ and columns_; MUMPS reads them only.
  double *entries(const Matrix &matrix)
  {
    if (symmetry_ == Symmetry::none)
      return const_cast<double *>(matrix.values().data());
    values_.resize(kept_.size());
    for (std::size_t k = 0; k < kept_.size(); ++k)
      values_[k] = matrix.values()[kept_[k]];
    return values_.data();
  }

  /// Fills what rank 0 needs: the ids of all ranks' values and the pivot order.
  void collect_order(const SparseGraph &graph)
  {
    const auto                comm = distribution_->comm();
    std::vector<int>          lengths;
    std::vector<std::int64_t> neighbours;
    for (int A = 0; A < graph.n_rows(); ++A)
      {
        lengths.push_back(static_cast<int>(graph.row(A).size()));
        for (const int B : graph.row(A))
          neighbours.push_back(distribution_->global(B));
      }
    const int count = distribution_->n_owned() * block_size_;
    counts_         = gather_on_root<int>(comm, MPI_INT, std::span(&count, 1));
    ids_ = gather_on_root<std::int64_t>(comm, MPI_INT64_T, distribution_->ids().first(distribution_->n_owned()));
    const auto all             = gather_on_root<std::int64_t>(comm, MPI_INT64_T, neighbours);
    const auto lengths_on_root = gather_on_root<int>(comm, MPI_INT, lengths);
    offsets_.resize(counts_.size());
    std::exclusive_scan(counts_.begin(), counts_.end(), offsets_.begin(), 0);
    rhs_.resize(ids_.size() * block_size_);
    order_.resize(rhs_.size());
    on_root(comm, [&] {
      const auto position = dissect(ids_, lengths_on_root, all);
      for (std::size_t a = 0; a < position.size(); ++a)
        for (int c = 0; c < block_size_; ++c)
          order_[a * block_size_ + c] = static_cast<MUMPS_INT>(position[a] * block_size_ + c + 1);
    });
  }

  Symmetry                            symmetry_;
  std::shared_ptr<const Distribution> distribution_;
  std::shared_ptr<const SparseGraph>  graph_; ///< of the running instance, empty if there is none
  int                                 block_size_ = 0;
  DMUMPS_STRUC_C                      mumps_      = {};
  std::vector<MUMPS_INT>              rows_, columns_, order_;
  std::vector<int>                    counts_, offsets_; ///< of the ranks' values on rank 0
  std::vector<std::int64_t>           ids_;              ///< control points, one rank after the other, on rank 0
  std::vector<std::size_t>            kept_;             ///< places of the values that a symmetric MUMPS is given
  std::vector<double>                 values_;           ///< those values
  std::vector<double>                 rhs_;              ///< in global numbering on rank 0
};

} // namespace

std::unique_ptr<Factorisation> make_mumps()
{
  return std::make_unique<Mumps>(Symmetry::none);
}

std::unique_ptr<SymmetricFactorisation> make_symmetric_mumps()
{
  return std::make_unique<Mumps>(Symmetry::general);
}

} // namespace sherd
