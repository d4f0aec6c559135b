#pragma once

#include <cctype>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tpetra_types.h"

namespace sherd::tpetra
{

/// Shows a function of owned values as an operator of Tpetra.
template <class Function>
class FunctionOperator final : public Operator
{
public:
  FunctionOperator(Teuchos::RCP<const Map> map, Function function)
      : map_(std::move(map)), function_(std::move(function))
  {
  }

  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }

  /// y = alpha f(x) + beta y, column by column.
  void apply(const MultiVector &x, MultiVector &y, Teuchos::ETransp, double alpha, double beta) const override
  {
    for (std::size_t column = 0; column < x.getNumVectors(); ++column)
      {
        const auto                    in_data  = x.getData(column);
        const auto                    out_data = y.getDataNonConst(column);
        const std::span<const double> in(in_data.getRawPtr(), in_data.size());
        const std::span<double>       out(out_data.getRawPtr(), out_data.size());
        if (alpha == 1. && beta == 0.)
          {
            function_(in, out);
            continue;
          }
        result_.resize(in.size());
        function_(in, std::span<double>(result_));
        for (std::size_t i = 0; i < result_.size(); ++i)
          out[i] = alpha * result_[i] + (beta == 0. ? 0. : beta * out[i]);
      }
  }

private:
  Teuchos::RCP<const Map>     map_;
  Function                    function_;
  mutable std::vector<double> result_;
};

template <class Function>
Teuchos::RCP<Operator> as_operator(const Teuchos::RCP<const Map> &map, Function function)
{
  return Teuchos::rcp(new FunctionOperator<Function>(map, std::move(function)));
}

/// The part of a message of Trilinos that is meant for people.
inline std::string last_line(std::string message)
{
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())))
    message.pop_back();
  return message.substr(message.rfind('\n') + 1);
}

} // namespace sherd::tpetra
