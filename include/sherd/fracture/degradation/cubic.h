#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/degradation/degradation.h>

#include <string>

namespace sherd::degradation
{

/// Cubic degradation g = (3 - s) phi^2 - (2 - s) phi^3, theory C.2; paper Eq. (7).
///
/// g'(1) = s: the response is nearly linear up to the onset of damage. With s = 0 the intact state would be stationary
/// under any load, so that a small positive s selects the branch that breaks.
class Cubic
{
public:
  /// @param slope  s in (0, 1].
  /// @throws InvalidParameter  outside that interval.
  explicit Cubic(const double slope = 1e-4) : s_(slope)
  {
    if (!(slope > 0. && slope <= 1.))
      throw InvalidParameter("cubic degradation: slope s = " + print(slope) +
                             " must lie in (0, 1]; the usual value is 1e-4");
  }

  double slope() const { return s_; }

  double value(const double phi) const { return phi * phi * ((3. - s_) - (2. - s_) * phi); }     ///< g
  double first(const double phi) const { return phi * (2. * (3. - s_) - 3. * (2. - s_) * phi); } ///< g'
  double second(const double phi) const { return 2. * (3. - s_) - 6. * (2. - s_) * phi; }        ///< g''

private:
  double s_;
};

static_assert(Degradation<Cubic>);

} // namespace sherd::degradation
