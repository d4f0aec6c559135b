#include <algorithm>
#include <string>

#include <Ifpack2_Factory.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "factorisation.h"
#include "tpetra_types.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

using Teuchos::RCP;
using Teuchos::rcp;
using CrsMatrix      = Tpetra::CrsMatrix<tpetra::Scalar, tpetra::Local, tpetra::Global, tpetra::Node>;
using RowMatrix      = Tpetra::RowMatrix<tpetra::Scalar, tpetra::Local, tpetra::Global, tpetra::Node>;
using Preconditioner = Ifpack2::Preconditioner<tpetra::Scalar, tpetra::Local, tpetra::Global, tpetra::Node>;

/// Map of the unknowns of the first @p n_blocks local control points.
RCP<const tpetra::Map> make_map(const Distribution &distribution, int n_blocks, int block_size)
{
  std::vector<tpetra::Global> ids;
  ids.reserve(static_cast<std::size_t>(n_blocks) * block_size);
  for (int a = 0; a < n_blocks; ++a)
    for (int c = 0; c < block_size; ++c)
      ids.push_back(distribution.global(a) * block_size + c);
  return rcp(new tpetra::Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids.data(),
                             static_cast<tpetra::Local>(ids.size()), 0, tpetra::communicator(distribution.comm())));
}

/// The same matrix as one of Tpetra, with explicit row and column maps so that the local order stays ours.
RCP<const CrsMatrix> copy(const Matrix &matrix)
{
  using Graph  = CrsMatrix::local_graph_device_type;
  using Values = CrsMatrix::local_matrix_device_type::values_type;

  const auto &distribution = matrix.distribution();
  const auto &graph        = matrix.graph();
  const int   block_size   = matrix.block_size();
  const auto  n_rows       = static_cast<std::size_t>(graph.n_rows()) * block_size;

  Graph::row_map_type::non_const_type offsets("offsets", n_rows + 1);
  Graph::entries_type::non_const_type columns("columns", matrix.values().size());
  Values                              values("values", matrix.values().size());
  std::copy(matrix.values().begin(), matrix.values().end(), values.data());
  std::size_t place = 0;
  for (int A = 0; A < graph.n_rows(); ++A)
    for (int c = 0; c < block_size; ++c)
      {
        for (const int B : graph.row(A))
          for (int d = 0; d < block_size; ++d)
            columns(place++) = B * block_size + d;
        offsets(static_cast<std::size_t>(A) * block_size + c + 1) = place;
      }
  const auto row_map    = make_map(distribution, distribution.n_owned(), block_size);
  const auto column_map = make_map(distribution, distribution.n_local(), block_size);
  const auto result     = rcp(new CrsMatrix(row_map, column_map, offsets, columns, values));
  result->expertStaticFillComplete(row_map, row_map);
  return result;
}

class Ifpack2Ilu final : public Factorisation
{
public:
  Ifpack2Ilu(int fill_level, int overlap) : fill_level_(fill_level), overlap_(overlap) {}

  void compute(const Matrix &matrix) override
  {
    try
      {
        const bool                 alone = matrix.distribution().n_ranks() == 1;
        const RCP<const CrsMatrix> rows  = copy(matrix);
        Teuchos::ParameterList     parameters;
        parameters.set("fact: iluk level-of-fill", fill_level_);
        if (alone)
          factors_ = Ifpack2::Factory::create<RowMatrix>("RILUK", rows);
        else
          {
            Teuchos::ParameterList schwarz;
            schwarz.set("schwarz: inner preconditioner name", "RILUK");
            schwarz.set("schwarz: inner preconditioner parameters", parameters);
            schwarz.set("schwarz: combine mode", "ZERO");
            schwarz.set("schwarz: overlap level", overlap_);
            parameters = schwarz;
            factors_   = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows, overlap_);
          }
        factors_->setParameters(parameters);
        factors_->initialize();
        factors_->compute();
        in_  = rcp(new tpetra::MultiVector(rows->getRowMap(), 1));
        out_ = rcp(new tpetra::MultiVector(rows->getRowMap(), 1));
      }
    catch (const std::exception &error)
      {
        throw NoConvergence(std::string("Ifpack2: ") + error.what());
      }
  }

  void apply(std::span<const double> r, std::span<double> z) override
  {
    std::copy(r.begin(), r.end(), in_->getDataNonConst(0).getRawPtr());
    factors_->apply(*in_, *out_);
    const auto result = out_->getData(0);
    std::copy_n(result.getRawPtr(), z.size(), z.begin());
  }

private:
  int                      fill_level_, overlap_;
  RCP<Preconditioner>      factors_;
  RCP<tpetra::MultiVector> in_, out_;
};

} // namespace

std::unique_ptr<Factorisation> make_ifpack2_ilu(int fill_level, int overlap)
{
  return std::make_unique<Ifpack2Ilu>(fill_level, overlap);
}

} // namespace sherd
