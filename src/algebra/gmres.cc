#include "gmres.h"

#include <algorithm>
#include <vector>

#include <BelosSolverFactory_Tpetra.hpp>

#include "exchange.h"
#include "function_operator.h"
#include "tpetra_types.h"

namespace sherd
{

using Teuchos::rcp;
using tpetra::MultiVector;

GmresResult gmres(const Matrix &matrix, Factorisation &factors, std::span<const double> r, std::span<double> z,
                  const GmresLimits &limits)
{
  const auto &distribution = matrix.distribution();
  const auto  map          = rcp(new tpetra::Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), r.size(), 0,
                                                 tpetra::communicator(distribution.comm())));

  std::vector<double> with_ghosts(static_cast<std::size_t>(distribution.n_local()) * matrix.block_size());
  const auto          system = tpetra::as_operator(map, [&](std::span<const double> in, std::span<double> out) {
    std::copy(in.begin(), in.end(), with_ghosts.begin());
    update_ghost_values(distribution, with_ghosts, matrix.block_size());
    // The residual of the initial guess, zero, is asked for twice.
    if (std::all_of(with_ghosts.begin(), with_ghosts.end(), [](double value) { return value == 0.; }))
      std::fill(out.begin(), out.end(), 0.);
    else
      matrix.multiply(with_ghosts, out);
  });
  const auto          preconditioner =
      tpetra::as_operator(map, [&](std::span<const double> in, std::span<double> out) { factors.apply(in, out); });

  const auto rhs = rcp(new MultiVector(map, 1)), solution = rcp(new MultiVector(map, 1));
  std::copy(r.begin(), r.end(), rhs->getDataNonConst(0).getRawPtr());

  const auto parameters = Teuchos::parameterList();
  parameters->set("Convergence Tolerance", limits.tolerance);
  parameters->set("Maximum Iterations", limits.max_iterations);
  // Keeps the preconditioned vectors, so that the solution takes no further product and no further preconditioning. To
  // check its residual is left to the caller.
  parameters->set("Flexible Gmres", true);
  parameters->set("Orthogonalization", "IMGS");
  parameters->set("Num Blocks", std::min(limits.restart, limits.max_iterations));
  parameters->set("Maximum Restarts", limits.max_iterations / limits.restart + 1);
  parameters->set("Implicit Residual Scaling", "Norm of Initial Residual");
  parameters->set("Explicit Residual Scaling", "Norm of Initial Residual");
  parameters->set("Verbosity", static_cast<int>(Belos::Errors));

  GmresResult result;
  try
    {
      Belos::SolverFactory<double, MultiVector, tpetra::Operator> factory;
      const auto                                                  solver = factory.create("BLOCK GMRES", parameters);
      const auto problem = rcp(new Belos::LinearProblem<double, MultiVector, tpetra::Operator>(system, solution, rhs));
      problem->setRightPrec(preconditioner);
      problem->setProblem();
      solver->setProblem(problem);
      solver->solve();
      result.iterations = solver->getNumIters();
    }
  catch (const std::exception &error)
    {
      result.failure = "GMRES broke down: " + tpetra::last_line(error.what());
    }
  const auto values = solution->getData(0);
  std::copy_n(values.getRawPtr(), z.size(), z.begin());
  return result;
}

} // namespace sherd
