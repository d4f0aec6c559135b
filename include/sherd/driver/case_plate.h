#pragma once

#include <sherd/driver/case_kernel.h>

/// The plate of case files with quadratic splines, which the library has compiled: a program that takes its policies by
/// name and has a loop of its own compiles in seconds.
namespace sherd
{

SHERD_CASE_ASSEMBLER(extern, 2, 2)
SHERD_CASE_HALVES(extern, 2, 2)
SHERD_CASE_SOLVERS(extern, 2, 2)

} // namespace sherd
