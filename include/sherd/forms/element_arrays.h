#pragma once

#include <sherd/base/types.h>
#include <sherd/geometry/shape_values.h>

namespace sherd
{

/// Bernstein coefficients of the fields of one element, index order [component][b].
template <class Model>
struct ElementFields
{
  static constexpr int n_b = ShapeValues<Model::degree>::n_functions;

  alignas(64) double position[Model::spacedim][n_b];     ///< x at the level of the balance of momentum
  alignas(64) double acceleration[Model::spacedim][n_b]; ///< a at its level, [length/time^2]
  alignas(64) double phase[n_b];                         ///< phi at its level
};

/// Element vector in Bernstein form, index order [field][b]; the fields are the displacements, then the phase.
template <class Model>
struct ElementVector
{
  static constexpr int n_b = ShapeValues<Model::degree>::n_functions;

  alignas(64) double value[Model::n_fields][n_b];
};

/// Element matrix in Bernstein form: row field*n_b + b, column likewise. Columns are padded to whole vector registers;
/// the padding holds zeros.
template <class Model>
struct ElementMatrix
{
  static constexpr int n_b    = ShapeValues<Model::degree>::n_functions;
  static constexpr int size   = Model::n_fields * n_b;
  static constexpr int stride = (size + 3 + 7) / 8 * 8;

  alignas(64) double value[size][stride];
};

namespace internal
{
/// Four doubles that the compiler keeps in one register.
typedef double Pack __attribute__((vector_size(32), aligned(8), may_alias));

template <int rows_of_c, int n_packs>
inline void add_rows(int rows, const double *A, int stride_a, const double *B, int stride_b, double *C, int stride_c)
{
  Pack sum[rows_of_c][n_packs] = {};
  for (int r = 0; r < rows; ++r)
    {
      const Pack *b = reinterpret_cast<const Pack *>(B + r * stride_b);
#pragma GCC unroll 8
      for (int i = 0; i < rows_of_c; ++i)
        {
          const double a = A[r * stride_a + i];
#pragma GCC unroll 8
          for (int j = 0; j < n_packs; ++j)
            sum[i][j] += a * b[j];
        }
    }
  for (int i = 0; i < rows_of_c; ++i)
    for (int j = 0; j < n_packs; ++j)
      *reinterpret_cast<Pack *>(C + i * stride_c + 4 * j) += sum[i][j];
}
} // namespace internal

/// Smallest multiple of four doubles that holds @p n: the padding of rows for whole vector registers.
constexpr int padded(int n)
{
  return (n + 3) / 4 * 4;
}

/// C += A^T B with A: rows x m, B: rows x N, C: m x N, all by rows with the given strides. N is a multiple of 4; where
/// it is padded, B holds zeros, which are added to whatever follows in the row of C.
template <int N>
inline void add_transposed_product(int m, int rows, const double *A, int stride_a, const double *B, int stride_b,
                                   double *C, int stride_c)
{
  static_assert(N % 4 == 0);
  // As many rows and columns of C at a time as leave their sums in registers.
  constexpr int n_parts = (N / 4 + 6) / 7;
  constexpr int packs   = (N / 4 + n_parts - 1) / n_parts;
  constexpr int block   = packs <= 3 ? 3 : 2;
  const int     whole   = m / block * block;
  for (int i = 0; i < whole; i += block)
    internal::add_rows<block, packs>(rows, A + i, stride_a, B, stride_b, C + i * stride_c, stride_c);
  for (int i = whole; i < m; ++i)
    internal::add_rows<1, packs>(rows, A + i, stride_a, B, stride_b, C + i * stride_c, stride_c);
  if constexpr (4 * packs < N)
    add_transposed_product<N - 4 * packs>(m, rows, A, stride_a, B + 4 * packs, stride_b, C + 4 * packs, stride_c);
}

} // namespace sherd
