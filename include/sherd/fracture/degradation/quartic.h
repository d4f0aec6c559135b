#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/fracture/degradation/degradation.h>

namespace sherd::degradation
{

/// Quartic degradation g = (4 - s) phi^3 - (3 - s) phi^4, theory C.2; s = 0 gives 4 phi^3 - 3 phi^4.
///
/// As the cubic function it leaves the response nearly linear up to the onset of damage, which comes at half the
/// energy: g'(1) = s, g''(1) = -12 + 6 s. With s = 0 the intact state would be stationary under any load, so that a
/// small positive s selects the branch that breaks.
class Quartic
{
public:
  /// @param slope  s in (0, 1].
  /// @throws InvalidParameter  outside that interval.
  explicit Quartic(const double slope = 1e-4) : s_(slope)
  {
    if (!(slope > 0. && slope <= 1.))
      throw InvalidParameter("quartic degradation: slope s = " + print(slope) +
                             " must lie in (0, 1]; the usual value is 1e-4");
  }

  double slope() const { return s_; }

  double value(const double phi) const { return phi * phi * phi * ((4. - s_) - (3. - s_) * phi); }     ///< g
  double first(const double phi) const { return phi * phi * (3. * (4. - s_) - 4. * (3. - s_) * phi); } ///< g'
  double second(const double phi) const { return phi * (6. * (4. - s_) - 12. * (3. - s_) * phi); }     ///< g''

private:
  double s_;
};

static_assert(Degradation<Quartic>);

} // namespace sherd::degradation
