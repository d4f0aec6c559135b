#include "gmres.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <BelosSolverFactory_Tpetra.hpp>

#include "exchange.h"
#include "tpetra_types.h"

namespace sherd
{

namespace
{

using Teuchos::RCP;
using Teuchos::rcp;
using tpetra::MultiVector;

/// Shows a function of owned values as an operator of Tpetra.
template <class Function>
class FunctionOperator final : public tpetra::Operator
{
public:
  FunctionOperator(RCP<const tpetra::Map> map, Function function) : map_(std::move(map)), function_(std::move(function))
  {
  }

  RCP<const tpetra::Map> getDomainMap() const override { return map_; }
  RCP<const tpetra::Map> getRangeMap() const override { return map_; }

  /// y = alpha f(x) + beta y, column by column.
  void apply(const MultiVector &x, MultiVector &y, Teuchos::ETransp, double alpha, double beta) const override
  {
    result_.resize(x.getLocalLength());
    for (std::size_t column = 0; column < x.getNumVectors(); ++column)
      {
        const auto in = x.getData(column);
        function_(std::span<const double>(in.getRawPtr(), in.size()), std::span<double>(result_));
        const auto out = y.getDataNonConst(column);
        for (std::size_t i = 0; i < result_.size(); ++i)
          out[i] = alpha * result_[i] + (beta == 0. ? 0. : beta * out[i]);
      }
  }

private:
  RCP<const tpetra::Map>      map_;
  Function                    function_;
  mutable std::vector<double> result_;
};

template <class Function>
RCP<tpetra::Operator> as_operator(const RCP<const tpetra::Map> &map, Function function)
{
  return rcp(new FunctionOperator<Function>(map, std::move(function)));
}

/// The part of a message of Trilinos that is meant for people.
std::string last_line(std::string message)
{
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())))
    message.pop_back();
  return message.substr(message.rfind('\n') + 1);
}

} // namespace

GmresResult gmres(const Matrix &matrix, Factorisation &factors, std::span<const double> r, std::span<double> z,
                  const GmresLimits &limits)
{
  const auto &distribution = matrix.distribution();
  const auto  map          = rcp(new tpetra::Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), r.size(), 0,
                                                 tpetra::communicator(distribution.comm())));

  std::vector<double> with_ghosts(static_cast<std::size_t>(distribution.n_local()) * matrix.block_size());
  const auto          system = as_operator(map, [&](std::span<const double> in, std::span<double> out) {
    std::copy(in.begin(), in.end(), with_ghosts.begin());
    update_ghost_values(distribution, with_ghosts, matrix.block_size());
    matrix.multiply(with_ghosts, out);
  });
  const auto          preconditioner =
      as_operator(map, [&](std::span<const double> in, std::span<double> out) { factors.apply(in, out); });

  const auto rhs = rcp(new MultiVector(map, 1)), solution = rcp(new MultiVector(map, 1));
  std::copy(r.begin(), r.end(), rhs->getDataNonConst(0).getRawPtr());

  const auto parameters = Teuchos::parameterList();
  parameters->set("Convergence Tolerance", limits.tolerance);
  parameters->set("Maximum Iterations", limits.max_iterations);
  parameters->set("Num Blocks", std::min(limits.restart, limits.max_iterations));
  parameters->set("Maximum Restarts", limits.max_iterations / limits.restart + 1);
  parameters->set("Implicit Residual Scaling", "Norm of Initial Residual");
  parameters->set("Explicit Residual Scaling", "Norm of Initial Residual");
  parameters->set("Verbosity", static_cast<int>(Belos::Errors));

  GmresResult result;
  try
    {
      Belos::SolverFactory<double, MultiVector, tpetra::Operator> factory;
      const auto                                                  solver = factory.create("GMRES", parameters);
      const auto problem = rcp(new Belos::LinearProblem<double, MultiVector, tpetra::Operator>(system, solution, rhs));
      problem->setRightPrec(preconditioner);
      problem->setProblem();
      solver->setProblem(problem);
      solver->solve();
      result.iterations = solver->getNumIters();
    }
  catch (const std::exception &error)
    {
      result.failure = "GMRES broke down: " + last_line(error.what());
    }
  const auto values = solution->getData(0);
  std::copy_n(values.getRawPtr(), z.size(), z.begin());
  return result;
}

} // namespace sherd
