#pragma once

/// Products of small dense tables, the floating point work of the element loop.
namespace sherd
{

namespace internal
{

#ifdef __AVX512F__
inline constexpr int pack_size   = 8;  // doubles in one vector register
inline constexpr int n_registers = 24; // that may hold sums
#else
inline constexpr int pack_size   = 4;
inline constexpr int n_registers = 12;
#endif

/// Doubles that the compiler keeps in one register.
typedef double Pack __attribute__((vector_size(8 * pack_size), aligned(8), may_alias));

} // namespace internal

/// Smallest multiple of whole vector registers that holds @p n doubles.
constexpr int padded(int n)
{
  return (n + internal::pack_size - 1) / internal::pack_size * internal::pack_size;
}

/// Left factor of a product: entry (i, r) is data[i * row + r * column].
struct Strided
{
  const double *data;
  int           row, column;
};

namespace internal
{

/// What happens to the old content of C.
enum class Content
{
  kept,
  replaced
};

template <Content content, int n_rows, int n_packs>
inline void multiply_rows(int depth, Strided A, const double *B, int stride_b, double *C, int stride_c)
{
  Pack sum[n_rows][n_packs] = {};
  for (int r = 0; r < depth; ++r)
    {
      const Pack *b = reinterpret_cast<const Pack *>(B + r * stride_b);
#pragma GCC unroll 8
      for (int i = 0; i < n_rows; ++i)
        {
          const double a = A.data[i * A.row + r * A.column];
#pragma GCC unroll 8
          for (int j = 0; j < n_packs; ++j)
            sum[i][j] += a * b[j];
        }
    }
#pragma GCC unroll 8
  for (int i = 0; i < n_rows; ++i)
#pragma GCC unroll 8
    for (int j = 0; j < n_packs; ++j)
      {
        Pack &c = *reinterpret_cast<Pack *>(C + i * stride_c + pack_size * j);
        c       = content == Content::kept ? c + sum[i][j] : sum[i][j];
      }
}

/// Rows of C, @p block at a time, then the rest in smaller blocks.
template <Content content, int block, int n_packs>
inline void multiply_row_blocks(int m, int depth, Strided A, const double *B, int stride_b, double *C, int stride_c)
{
  int        i    = 0;
  const auto rows = [&](int first) { return Strided{A.data + first * A.row, A.row, A.column}; };
  for (; i + block <= m; i += block)
    multiply_rows<content, block, n_packs>(depth, rows(i), B, stride_b, C + i * stride_c, stride_c);
  if constexpr (block > 1)
    if (i < m)
      multiply_row_blocks<content, block / 2, n_packs>(m - i, depth, rows(i), B, stride_b, C + i * stride_c, stride_c);
}

template <Content content, int N>
inline void multiply(int m, int depth, Strided A, const double *B, int stride_b, double *C, int stride_c)
{
  static_assert(N % pack_size == 0);
  // As many rows and columns of C at a time as leave their sums in registers.
  constexpr int n_packs = N / pack_size;
  constexpr int n_parts = (n_packs + 7) / 8;
  constexpr int packs   = (n_packs + n_parts - 1) / n_parts;
  constexpr int fitting = n_registers / packs;
  constexpr int block   = fitting < 1 ? 1 : fitting > 4 ? 4 : fitting;
  multiply_row_blocks<content, block, packs>(m, depth, A, B, stride_b, C, stride_c);
  if constexpr (packs < n_packs)
    multiply<content, N - pack_size * packs>(m, depth, A, B + pack_size * packs, stride_b, C + pack_size * packs,
                                             stride_c);
}

} // namespace internal

/// C = A B with A: m x depth, B: depth x N and C: m x N, the latter two by rows with the given strides.
/// @tparam N   padded(): what B holds beyond the columns that are meant lands beyond them in C
template <int N>
inline void set_product(int m, int depth, Strided A, const double *B, int stride_b, double *C, int stride_c)
{
  internal::multiply<internal::Content::replaced, N>(m, depth, A, B, stride_b, C, stride_c);
}

/// C += A B, otherwise as set_product.
template <int N>
inline void add_product(int m, int depth, Strided A, const double *B, int stride_b, double *C, int stride_c)
{
  internal::multiply<internal::Content::kept, N>(m, depth, A, B, stride_b, C, stride_c);
}

} // namespace sherd
