#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <omp.h>

#include "exchange.h"
#include "factorisation.h"
#include <sherd/algebra/block_ilu.h>
#include <sherd/base/collective.h>

namespace sherd
{

namespace
{

/// Fewer rows than these do not repay a thread and lengthen the separators.
constexpr int rows_of_a_thread = 500;

int n_threads(int n_rows)
{
  return std::clamp(n_rows / rows_of_a_thread, 1, omp_get_max_threads());
}

/// Marks the block rows of an equilibrated matrix in which a diagonal is next to nothing, shape=(n_rows). Rows of other
/// ranks, which come behind the owned ones, are not marked.
std::vector<char> rows_of_multipliers(const Matrix &matrix, int n_rows)
{
  constexpr double  small = 1e-2;
  std::vector<char> result(n_rows, 0);
  for (int A = 0; A < matrix.graph().n_rows(); ++A)
    for (int c = 0; c < matrix.block_size(); ++c)
      {
        const auto length  = static_cast<std::size_t>(matrix.row_length(A));
        double     largest = 0.;
        for (const double value : matrix.values().subspan(matrix.row_start(A) + c * length, length))
          largest = std::max(largest, std::abs(value));
        if (std::abs(matrix.diagonal(A, c)) < small * largest)
          result[A] = 1;
      }
  return result;
}

class PointBlockIlu final : public Factorisation
{
public:
  PointBlockIlu(int fill_level, int overlap) : fill_level_(fill_level), overlap_(overlap) {}

  void compute(const Matrix &matrix) override
  {
    const auto &distribution = matrix.distribution();
    const bool  overlapping  = overlap_ > 0 && distribution.n_ranks() > 1;
    if (matrix.shared_graph() != graph_ || matrix.block_size() != factors_->block_size())
      {
        graph_.reset();
        distribution_ = matrix.shared_distribution();
        ghost_rows_.reset();
        if (overlapping)
          ghost_rows_.emplace(distribution, matrix.graph());
        collectively(distribution.comm(), [&] {
          const auto &graph = overlapping ? ghost_rows_->extended_graph() : matrix.graph();
          factors_.emplace(graph, matrix.block_size(), fill_level_, n_threads(distribution.n_local()),
                           rows_of_multipliers(matrix, graph.n_rows()));
        });
        graph_ = matrix.shared_graph();
      }
    const auto ghost_values = overlapping ? ghost_rows_->fetch(matrix) : std::vector<double>();
    collectively(distribution.comm(), [&] {
      factors_->factor(overlapping ? ghost_rows_->extended_graph() : matrix.graph(), matrix.values(), ghost_values);
    });
  }

  void apply(std::span<const double> r, std::span<double> z) override
  {
    if (!ghost_rows_)
      {
        factors_->solve(r, z);
        return;
      }
    work_.resize(static_cast<std::size_t>(factors_->n_rows()) * factors_->block_size());
    std::copy(r.begin(), r.end(), work_.begin());
    update_ghost_values(*distribution_, work_, factors_->block_size());
    factors_->solve(work_);
    std::copy_n(work_.begin(), z.size(), z.begin());
  }

private:
  int                                 fill_level_, overlap_;
  std::shared_ptr<const Distribution> distribution_;
  std::shared_ptr<const SparseGraph>  graph_; ///< the factors' symbolic phase belongs to it
  std::optional<GhostRows>            ghost_rows_;
  std::optional<BlockIlu>             factors_;
  std::vector<double>                 work_;
};

} // namespace

std::unique_ptr<Factorisation> make_point_block_ilu(int fill_level, int overlap)
{
  return std::make_unique<PointBlockIlu>(fill_level, overlap);
}

} // namespace sherd
