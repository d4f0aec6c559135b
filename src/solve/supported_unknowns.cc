#include <sherd/solve/supported_unknowns.h>

namespace sherd
{

void decouple_rows(Matrix &matrix, const std::vector<char> &fixed)
{
  decouple_rows(matrix, fixed, matrix.block_size(), {0, matrix.block_size()});
}

void decouple_rows(Matrix &matrix, const std::vector<char> &fixed, int n_fields, FieldRange range)
{
  for (int a = 0; a < matrix.distribution().n_owned(); ++a)
    for (int c = 0; c < range.count; ++c)
      if (fixed[a * n_fields + range.first + c])
        {
          const double kept  = matrix.diagonal(a, c);
          const auto   start = matrix.values().begin() + matrix.row_start(a) + c * matrix.row_length(a);
          std::fill(start, start + matrix.row_length(a), 0.);
          matrix.diagonal(a, c) = kept;
        }
}

} // namespace sherd
