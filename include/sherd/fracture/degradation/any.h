#pragma once

#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/fracture/degradation/quartic.h>
#include <sherd/fracture/degradation/rational.h>
#include <sherd/fracture/degradation/with_residual.h>

#include <utility>
#include <variant>

namespace sherd::degradation
{

/// A degradation function chosen at run time, for programs that read its name: one compiled kernel serves all.
///
/// A program that knows its function names that type instead, and pays nothing for the choice.
class Any
{
public:
  using Function = std::variant<Cubic, Quadratic, Quartic, Rational>;

  /// @param function  one of the functions shipped.
  /// @param eta       residual stiffness, see WithResidual.
  /// @throws InvalidParameter  for eta outside [0, 1).
  Any(Function function = Cubic(), const double eta = 0.) : function_(std::move(function)), eta_(eta)
  {
    WithResidual(Cubic(), eta);
  }

  double residual() const { return eta_; }

  double value(const double phi) const
  {
    return (1. - eta_) * std::visit([phi](const auto &g) { return g.value(phi); }, function_) + eta_;
  }
  double first(const double phi) const
  {
    return (1. - eta_) * std::visit([phi](const auto &g) { return g.first(phi); }, function_);
  }
  double second(const double phi) const
  {
    return (1. - eta_) * std::visit([phi](const auto &g) { return g.second(phi); }, function_);
  }

private:
  Function function_;
  double   eta_;
};

static_assert(Degradation<Any>);

} // namespace sherd::degradation
