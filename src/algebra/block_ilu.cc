// The numeric phase and the substitution.
#include <sherd/algebra/block_ilu.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#ifdef __AVX__
#  include <immintrin.h>
#endif
#include <omp.h>

#include "registers.h"
#include <sherd/base/exceptions.h>

namespace sherd
{

namespace
{

/// Inverts a small matrix in place (Gauss-Jordan with column pivots); false if it is singular.
template <int n>
bool invert(double (&a)[n * n])
{
  double inverse[n * n] = {};
  for (int i = 0; i < n; ++i)
    inverse[i * n + i] = 1.;
  for (int k = 0; k < n; ++k)
    {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k]))
          pivot = i;
      const double value = a[pivot * n + k];
      if (value == 0. || !std::isfinite(value))
        return false;
      for (int j = 0; j < n; ++j)
        {
          std::swap(a[k * n + j], a[pivot * n + j]);
          std::swap(inverse[k * n + j], inverse[pivot * n + j]);
        }
      for (int j = 0; j < n; ++j)
        {
          a[k * n + j] /= value;
          inverse[k * n + j] /= value;
        }
      for (int i = 0; i < n; ++i)
        if (i != k)
          {
            const double factor = a[i * n + k];
            for (int j = 0; j < n; ++j)
              {
                a[i * n + j] -= factor * a[k * n + j];
                inverse[i * n + j] -= factor * inverse[k * n + j];
              }
          }
    }
  for (int i = 0; i < n * n; ++i)
    a[i] = inverse[i];
  return true;
}

/// Rows of blocks and blocks of vectors in registers. What a block does not fill holds numbers that nobody reads.
template <int block_size>
struct Lanes
{
  static constexpr int width = block_size <= 2 ? 2 : 4;
  using Doubles              = typename Registers<width>::Doubles;
  using Floats               = typename Registers<width>::Floats;

  static const Doubles &at(const double *place) { return *reinterpret_cast<const Doubles *>(place); }
  static Doubles       &at(double *place) { return *reinterpret_cast<Doubles *>(place); }
  static Doubles        filled(double value) { return Doubles{} + value; }
  static Doubles        widened(const float *place)
  {
#ifdef __AVX__ // in one instruction, which not every compiler finds
    if constexpr (width == 4)
      return _mm256_cvtps_pd(_mm_loadu_ps(place));
    else
#endif
      return __builtin_convertvector(*reinterpret_cast<const Floats *>(place), Doubles);
  }
};

bool all_finite(std::span<const float> values)
{
  constexpr std::size_t n_lanes        = 16;
  float                 zeros[n_lanes] = {}, zero = 0.F; // sums of zeros, or of what is not finite
  const auto            n_whole = values.size() / n_lanes * n_lanes;
  for (std::size_t m = 0; m < n_whole; m += n_lanes)
    for (std::size_t lane = 0; lane < n_lanes; ++lane)
      zeros[lane] += values[m + lane] * 0.F;
  for (std::size_t m = n_whole; m < values.size(); ++m)
    zero += values[m] * 0.F;
  for (const float lane : zeros)
    zero += lane;
  return zero == 0.F;
}

/// Sum of blocks times blocks of a vector.
template <int block_size>
struct RowSum
{
  using Lane                              = Lanes<block_size>;
  typename Lane::Doubles sums[block_size] = {};

  void add(const float *block, const double *vector)
  {
    const auto in = Lane::at(vector);
    for (int c = 0; c < block_size; ++c)
      sums[c] += Lane::widened(block + c * block_size) * in;
  }

  double component(int c) const
  {
    double result = sums[c][0];
    for (int d = 1; d < block_size; ++d)
      result += sums[c][d];
    return result;
  }
};

} // namespace

struct BlockIlu::Workspace
{
  std::vector<int>    slots;  ///< of each column among the kept blocks of the current row, -1 for the others
  std::vector<double> blocks; ///< of the current row, their rows padded to whole registers
};

template <int block_size>
std::string BlockIlu::factor_part(int part, const SparseGraph &graph, std::span<const double> values,
                                  std::span<const double> more_values, std::span<const int> positions,
                                  Workspace &workspace)
{
  using Lane           = Lanes<block_size>;
  constexpr int size   = block_size * block_size;
  constexpr int width  = Lane::width;
  constexpr int padded = block_size * width;
  auto         &slots  = workspace.slots;
  slots.assign(n_rows(), -1);
  for (int i = parts_[part]; i < parts_[part + 1]; ++i)
    {
      const std::span<const int> left(lower_.columns.data() + lower_.offsets[i],
                                      lower_.columns.data() + lower_.offsets[i + 1]);
      const std::span<const int> right(upper_.columns.data() + upper_.offsets[i],
                                       upper_.columns.data() + upper_.offsets[i + 1]);
      const int                  n_left = static_cast<int>(left.size()), n_right = static_cast<int>(right.size());
      for (int k = 0; k < n_left; ++k)
        slots[left[k]] = k;
      for (int k = 0; k < n_right; ++k)
        slots[right[k]] = n_left + k;
      workspace.blocks.assign(static_cast<std::size_t>(n_left + n_right) * padded, 0.);
      double *const work = workspace.blocks.data();

      const int     r     = order_[i];
      const auto    first = static_cast<std::size_t>(graph.offsets[r]) * size;
      const double *row = first < values.size() ? values.data() + first : more_values.data() + (first - values.size());
      const auto    blocks = graph.row(r);
      const auto    length = blocks.size() * block_size;
      for (std::size_t k = 0; k < blocks.size(); ++k)
        if (blocks[k] < n_rows())
          {
            double *const block = work + static_cast<std::size_t>(slots[positions[blocks[k]]]) * padded;
            for (int c = 0; c < block_size; ++c)
              for (int d = 0; d < block_size; ++d)
                block[c * width + d] = row[c * length + k * block_size + d];
          }

      for (int k = 0; k < n_left; ++k)
        {
          const auto    begin = upper_.offsets[left[k]], end = upper_.offsets[left[k] + 1];
          double *const entry   = work + k * padded;
          const float  *inverse = upper_.values.data() + begin * size;
          for (int c = 0; c < block_size; ++c)
            {
              auto sum = entry[c * width] * Lane::widened(inverse);
              for (int m = 1; m < block_size; ++m)
                sum += entry[c * width + m] * Lane::widened(inverse + m * block_size);
              Lane::at(entry + c * width) = sum;
            }
          typename Lane::Doubles lower[block_size][block_size];
          for (int c = 0; c < block_size; ++c)
            for (int m = 0; m < block_size; ++m)
              lower[c][m] = Lane::filled(entry[c * width + m]);
          for (auto q = begin + 1; q < end; ++q)
            if (const int slot = slots[upper_.columns[q]]; slot >= 0)
              {
                double                *target = work + slot * padded;
                const float           *upper  = upper_.values.data() + q * size;
                typename Lane::Doubles rows[block_size];
                for (int m = 0; m < block_size; ++m)
                  rows[m] = Lane::widened(upper + m * block_size);
                for (int c = 0; c < block_size; ++c)
                  {
                    auto sum = Lane::at(target + c * width);
                    for (int m = 0; m < block_size; ++m)
                      sum -= lower[c][m] * rows[m];
                    Lane::at(target + c * width) = sum;
                  }
              }
        }

      double        pivot[size];
      double *const diagonal = work + n_left * padded;
      for (int c = 0; c < block_size; ++c)
        std::copy_n(diagonal + c * width, block_size, pivot + c * block_size);
      if (!invert<block_size>(pivot))
        return "incomplete factors: singular diagonal block in row " + std::to_string(r);
      for (int c = 0; c < block_size; ++c)
        std::copy_n(pivot + c * block_size, block_size, diagonal + c * width);

      const auto store = [](const double *from, int n_blocks, std::span<float> to) {
        for (int k = 0; k < n_blocks * block_size; ++k)
          for (int d = 0; d < block_size; ++d)
            to[k * block_size + d] = static_cast<float>(from[k * width + d]);
        return all_finite(to);
      };
      const std::span<float> left_values(lower_.values.data() + lower_.offsets[i] * size, left.size() * size);
      const std::span<float> right_values(upper_.values.data() + upper_.offsets[i] * size, right.size() * size);
      const bool             left_finite = store(work, n_left, left_values);
      if (!store(diagonal, n_right, right_values) || !left_finite)
        return "incomplete factors: value out of range in row " + std::to_string(r);
      for (const int j : left)
        slots[j] = -1;
      for (const int j : right)
        slots[j] = -1;
    }
  return {};
}

template <int block_size>
void BlockIlu::factor_blocks(const SparseGraph &graph, std::span<const double> values,
                             std::span<const double> more_values)
{
  std::vector<int> positions(n_rows());
  for (int i = 0; i < n_rows(); ++i)
    positions[order_[i]] = i;
  std::vector<Workspace>   workspaces(n_threads_);
  std::vector<std::string> failures(2 * n_threads_);
  const auto               factor_part = [&](int part) {
    failures[part] =
        this->factor_part<block_size>(part, graph, values, more_values, positions, workspaces[omp_get_thread_num()]);
  };
  const auto check = [&] {
    for (const auto &failure : failures)
      if (!failure.empty())
        throw NoConvergence(failure);
  };
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1)
  for (int part = 0; part < n_threads_; ++part)
    factor_part(part);
  check();
#pragma omp parallel for num_threads(n_threads_) schedule(static, 1) if (!separators_coupled_)
  for (int part = n_threads_; part < 2 * n_threads_; ++part)
    factor_part(part);
  check();
}

template <int block_size>
void BlockIlu::sweep_forward(int part, const double *b)
{
  constexpr int width = Lanes<block_size>::width;
  for (int i = parts_[part]; i < parts_[part + 1]; ++i)
    {
      RowSum<block_size> sum;
      for (auto p = lower_.offsets[i]; p < lower_.offsets[i + 1]; ++p)
        sum.add(lower_.values.data() + p * block_size * block_size,
                work_.data() + static_cast<std::size_t>(lower_.columns[p]) * width);
      const double *in  = b + static_cast<std::size_t>(order_[i]) * block_size;
      double       *out = work_.data() + static_cast<std::size_t>(i) * width;
      for (int c = 0; c < block_size; ++c)
        out[c] = in[c] - sum.component(c);
    }
}

template <int block_size>
void BlockIlu::sweep_backward(int part, double *x)
{
  constexpr int width = Lanes<block_size>::width, size = block_size * block_size;
  for (int i = parts_[part + 1] - 1; i >= parts_[part]; --i)
    {
      const auto         first = upper_.offsets[i];
      RowSum<block_size> sum;
      for (auto p = upper_.offsets[i + 1] - 1; p > first; --p)
        sum.add(upper_.values.data() + p * size, work_.data() + static_cast<std::size_t>(upper_.columns[p]) * width);
      double *const work = work_.data() + static_cast<std::size_t>(i) * width;
      for (int c = 0; c < block_size; ++c)
        work[c] -= sum.component(c);
      RowSum<block_size> result;
      result.add(upper_.values.data() + first * size, work);
      double *const out = x + static_cast<std::size_t>(order_[i]) * block_size;
      for (int c = 0; c < block_size; ++c)
        out[c] = work[c] = result.component(c);
    }
}

template <int block_size>
void BlockIlu::solve_blocks(const double *b, double *x)
{
#pragma omp parallel num_threads(n_threads_) if (n_threads_ > 1)
  {
#pragma omp for schedule(static, 1)
    for (int part = 0; part < n_threads_; ++part)
      sweep_forward<block_size>(part, b);
    if (separators_coupled_)
      {
#pragma omp single
        {
          for (int part = n_threads_; part < 2 * n_threads_; ++part)
            sweep_forward<block_size>(part, b);
          for (int part = 2 * n_threads_ - 1; part >= n_threads_; --part)
            sweep_backward<block_size>(part, x);
        }
      }
    else
      {
#pragma omp for schedule(static, 1)
        for (int part = n_threads_; part < 2 * n_threads_; ++part)
          {
            sweep_forward<block_size>(part, b);
            sweep_backward<block_size>(part, x);
          }
      }
#pragma omp for schedule(static, 1)
    for (int part = 0; part < n_threads_; ++part)
      sweep_backward<block_size>(part, x);
  }
}

void BlockIlu::factor(const SparseGraph &graph, std::span<const double> values, std::span<const double> more_values)
{
  const auto expected = static_cast<std::size_t>(graph.offsets.back()) * block_size_ * block_size_;
  if (graph.n_rows() != n_rows() || values.size() + more_values.size() != expected)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows()) +
                            " rows: " + std::to_string(graph.n_rows()) + " rows and " +
                            std::to_string(values.size() + more_values.size()) + " values given, expected " +
                            std::to_string(expected) + " values");
  switch (block_size_)
    {
    case 1:
      return factor_blocks<1>(graph, values, more_values);
    case 2:
      return factor_blocks<2>(graph, values, more_values);
    case 3:
      return factor_blocks<3>(graph, values, more_values);
    default:
      return factor_blocks<4>(graph, values, more_values);
    }
}

void BlockIlu::solve(std::span<const double> b, std::span<double> x)
{
  const auto expected = static_cast<std::size_t>(n_rows()) * block_size_;
  if (b.size() != expected || x.size() != expected)
    throw DimensionMismatch("incomplete factors of " + std::to_string(n_rows()) + " rows of blocks of " +
                            std::to_string(block_size_) + " applied to " + std::to_string(b.size()) +
                            " values, result in " + std::to_string(x.size()));
  switch (block_size_)
    {
    case 1:
      return solve_blocks<1>(b.data(), x.data());
    case 2:
      return solve_blocks<2>(b.data(), x.data());
    case 3:
      return solve_blocks<3>(b.data(), x.data());
    default:
      return solve_blocks<4>(b.data(), x.data());
    }
}

} // namespace sherd
