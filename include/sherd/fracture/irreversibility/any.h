#pragma once

#include <sherd/fracture/irreversibility/history.h>
#include <sherd/fracture/irreversibility/none.h>
#include <sherd/fracture/irreversibility/penalty.h>

#include <utility>
#include <variant>

namespace sherd::irreversibility
{

/// An irreversibility chosen at run time, for programs that read its name: one compiled kernel serves all.
///
/// A program that knows its rule names that type instead, and pays nothing for the choice.
class Any
{
public:
  using Policy = std::variant<History, Penalty, None>;

  Any(Policy policy = History{}) : policy_(std::move(policy)) {}

  double trial(const double memory, const double energy) const
  {
    return std::visit([=](const auto &p) { return p.trial(memory, energy); }, policy_);
  }
  bool is_loading(const double memory, const double energy) const
  {
    return std::visit([=](const auto &p) { return p.is_loading(memory, energy); }, policy_);
  }
  double resistance(const double memory, const double phi) const
  {
    return std::visit([=](const auto &p) { return p.resistance(memory, phi); }, policy_);
  }
  double resistance_stiffness(const double memory, const double phi) const
  {
    return std::visit([=](const auto &p) { return p.resistance_stiffness(memory, phi); }, policy_);
  }
  double commit(const double memory, const double energy, const double phi) const
  {
    return std::visit([=](const auto &p) { return p.commit(memory, energy, phi); }, policy_);
  }
  double initial(const double energy, const double phi) const
  {
    return std::visit([=](const auto &p) { return p.initial(energy, phi); }, policy_);
  }

private:
  Policy policy_;
};

static_assert(Irreversibility<Any>);

} // namespace sherd::irreversibility
