#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sherd/base/parameter_section.h>
#include <sherd/driver/vector_formula.h>
#include <sherd/forms/loads.h>
#include <sherd/space/supports.h>

namespace sherd
{

/// One support of a case, on named edges, a corner, a patch or everything.
struct SupportParameters
{
  std::string              kind = "fix";
  std::vector<std::string> edges;
  std::vector<std::string> corner;
  std::optional<int>       patch;
  bool                     everywhere   = false;
  std::string              component    = "all";
  Formula                  displacement = Formula("0", {"t"});
  Formula                  angle        = Formula("0", {"t"});

  void declare(ParameterSection &section);

  /// Adds it. @param where   its place in the case file, for messages
  /// @throws InvalidParameter   a region or component that is missing, or parameters that this kind does not have
  void add_to(Supports &supports, int dimension, const std::string &where) const;
};

/// One load of a case.
struct LoadParameters
{
  std::string              kind = "traction";
  std::vector<std::string> edges;
  std::vector<double>      point;
  VectorFormula            vector;
  Formula                  value   = Formula("0", VectorFormula::variables());
  PressureRelease          release = PressureRelease::none;

  void declare(ParameterSection &section);

  /// Adds it. @param density   mass by area, for gravity
  /// @throws InvalidParameter   as SupportParameters::add_to
  template <int spacedim>
  void add_to(Loads<spacedim> &loads, double density, const std::string &where) const;
};

extern template void LoadParameters::add_to(Loads<2> &, double, const std::string &) const;
extern template void LoadParameters::add_to(Loads<3> &, double, const std::string &) const;

} // namespace sherd
