#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace sherd
{

/// Work of what acts on a surface from outside, over a step or a run [energy].
struct ExternalWork
{
  double              supports = 0.; ///< of the forces that move prescribed displacements
  std::vector<double> loads;         ///< of each load, in the order of Loads::names(); empty: none so far

  double of_loads() const { return std::accumulate(loads.begin(), loads.end(), 0.); }
  double total() const { return supports + of_loads(); }

  /// @pre the loads of both are the same, or one has none
  ExternalWork &operator+=(const ExternalWork &other)
  {
    supports += other.supports;
    loads.resize(std::max(loads.size(), other.loads.size()), 0.);
    for (std::size_t i = 0; i < other.loads.size(); ++i)
      loads[i] += other.loads[i];
    return *this;
  }
};

/// Work of all forces over a step [energy]. In a step that is solved exactly internal = external.total(): what the
/// forces of the balance do on the way from its beginning to its end.
struct StepWork
{
  ExternalWork external;
  double       internal = 0.; ///< (f_int + M a) . dx + f_phi . dphi, of the internal and inertial forces
  double       inertial = 0.; ///< M a . dx of it

  StepWork &operator+=(const StepWork &other)
  {
    external += other.external;
    internal += other.internal;
    inertial += other.inertial;
    return *this;
  }
};

} // namespace sherd
