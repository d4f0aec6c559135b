#pragma once

#include <sherd/fracture/crack_density/at1.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/crack_density/second_order.h>

#include <utility>
#include <variant>

namespace sherd::crack_density
{

/// A crack density chosen at run time, for programs that read its name: one compiled kernel serves all.
///
/// A program that knows its density names that type instead, and pays nothing for the choice.
class Any
{
public:
  using Density = std::variant<FourthOrder, SecondOrder, AT1>;

  static constexpr int order = 4; ///< the highest of the choices

  Any(Density density = FourthOrder{}) : density_(std::move(density)) {}

  double local(const double phi) const
  {
    return std::visit([phi](const auto &d) { return d.local(phi); }, density_);
  }
  double local_first(const double phi) const
  {
    return std::visit([phi](const auto &d) { return d.local_first(phi); }, density_);
  }
  double local_second(const double phi) const
  {
    return std::visit([phi](const auto &d) { return d.local_second(phi); }, density_);
  }
  double c1(const double l0) const
  {
    return std::visit([l0](const auto &d) { return d.c1(l0); }, density_);
  }
  double c2(const double l0) const
  {
    return std::visit([l0](const auto &d) { return d.c2(l0); }, density_);
  }
  double profile(const double r) const
  {
    return std::visit([r](const auto &d) { return d.profile(r); }, density_);
  }

private:
  Density density_;
};

static_assert(CrackDensity<Any>);

} // namespace sherd::crack_density
