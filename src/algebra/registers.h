#pragma once

namespace sherd
{

/// Vector registers of @p width numbers, for numbers that lie anywhere in memory.
template <int width>
struct Registers;

template <>
struct Registers<2>
{
  typedef double Doubles __attribute__((vector_size(16), aligned(8), may_alias));
  typedef float  Floats __attribute__((vector_size(8), aligned(4), may_alias));
};

template <>
struct Registers<4>
{
  typedef double Doubles __attribute__((vector_size(32), aligned(8), may_alias));
  typedef float  Floats __attribute__((vector_size(16), aligned(4), may_alias));
};

} // namespace sherd
