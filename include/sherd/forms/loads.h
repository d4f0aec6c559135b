#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sherd/base/types.h>

namespace sherd
{

/// Dead loads: they keep their direction and refer to the reference surface. Declared once by the name of an edge or
/// for the whole surface; they follow refinement.
///
/// Source: theory E.3.
template <int spacedim>
class Loads
{
public:
  using Function = std::function<Point<spacedim>(const Point<spacedim> &X, double time)>;

  struct Traction
  {
    std::string edge;
    Function    traction; ///< [force/length]
  };

  /// f_A = int N_A t(X, time) dS on a named edge. @p traction [force/length]
  void traction(const std::string &edge, Function traction) { tractions_.push_back({edge, std::move(traction)}); }

  /// f_A = int N_A f(X, time) dA on the whole surface. @p force [force/area]
  void body_force(Function force) { body_forces_.push_back(std::move(force)); }

  const std::vector<Traction> &tractions() const { return tractions_; }
  const std::vector<Function> &body_forces() const { return body_forces_; }

private:
  std::vector<Traction> tractions_;
  std::vector<Function> body_forces_;
};

} // namespace sherd
