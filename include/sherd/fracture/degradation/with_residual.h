#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/degradation/cubic.h>

namespace sherd::degradation
{

/// Any degradation function with a residual stiffness eta: (1 - eta) g + eta, theory C.2.
///
/// A broken surface keeps the share eta of its active stiffness, which quasi-static problems need where a part is cut
/// off (1e-8 is usual); dynamic ones have their mass.
template <Degradation Function>
class WithResidual
{
public:
  /// @param eta  in [0, 1).
  /// @throws InvalidParameter  outside that interval.
  explicit WithResidual(const Function &function, const double eta = 1e-8) : function_(function), eta_(eta)
  {
    if (!(eta >= 0. && eta < 1.))
      throw InvalidParameter("degradation: residual stiffness " + print(eta) +
                             " must lie in [0, 1); the usual value is 1e-8");
  }

  const Function &function() const { return function_; }
  double          residual() const { return eta_; }

  double value(const double phi) const { return (1. - eta_) * function_.value(phi) + eta_; } ///< (1 - eta) g + eta
  double first(const double phi) const { return (1. - eta_) * function_.first(phi); }        ///< (1 - eta) g'
  double second(const double phi) const { return (1. - eta_) * function_.second(phi); }      ///< (1 - eta) g''

private:
  Function function_;
  double   eta_;
};

static_assert(Degradation<WithResidual<Cubic>>);

} // namespace sherd::degradation
