#pragma once

#include <sherd/assembly/assembler.h>

/// The element loops of half problems of the models named by the arguments after the first, for explicit instantiation:
/// the prefix is empty where they are compiled and extern where they are used.
#define SHERD_HALF_KERNELS(prefix, ...)                                                                                \
  prefix template void Assembler<__VA_ARGS__>::part_force<Unknowns::displacement>(                                     \
      const BalanceLevel &, const QuadratureField &, const LoadValues<__VA_ARGS__> &, Vector &, Vector &) const;       \
  prefix template void Assembler<__VA_ARGS__>::part_force<Unknowns::phase>(                                            \
      const BalanceLevel &, const QuadratureField &, const LoadValues<__VA_ARGS__> &, Vector &, Vector &) const;       \
  prefix template void Assembler<__VA_ARGS__>::linearise_part<Unknowns::displacement>(                                 \
      const BalanceLevel &, const QuadratureField &, double, PhaseTangent, const LoadValues<__VA_ARGS__> &, Vector &,  \
      Vector &, Matrix &) const;                                                                                       \
  prefix template void Assembler<__VA_ARGS__>::linearise_part<Unknowns::phase>(                                        \
      const BalanceLevel &, const QuadratureField &, double, PhaseTangent, const LoadValues<__VA_ARGS__> &, Vector &,  \
      Vector &, Matrix &) const;                                                                                       \
  prefix template void Assembler<__VA_ARGS__>::part_mass_matrix<Unknowns::displacement>(Matrix &) const;
