#include <sherd/spline/extraction.h>

#include <array>

namespace sherd
{

namespace
{

/// Bernstein coefficients on one interval. Functions of an element share most of their univariate factors, so each is
/// computed once.
template <int degree>
class Factors
{
public:
  using Coefficients = std::array<double, degree + 1>;

  Factors(double a, double b) : a_(a), b_(b) {}

  const Coefficients &operator()(const LocalKnots<degree> &knots)
  {
    for (int k = 0; k < n_; ++k)
      if (*knots_[k] == knots)
        return coefficients_[k];
    const int k      = n_ < capacity ? n_++ : capacity - 1;
    knots_[k]        = &knots;
    coefficients_[k] = bernstein_coefficients<degree>(knots, a_, b_);
    return coefficients_[k];
  }

private:
  static constexpr int capacity = 4 * (degree + 1);

  double                                           a_, b_;
  int                                              n_ = 0;
  std::array<const LocalKnots<degree> *, capacity> knots_;
  std::array<Coefficients, capacity>               coefficients_;
};

} // namespace

template <int degree>
ExtractionMatrix<degree> extraction(const LRBasis<degree> &basis, int e)
{
  const auto              &box       = basis.element(e);
  const auto               functions = basis.functions_of(e);
  Factors<degree>          factors_u(box.min[0], box.max[0]), factors_v(box.min[1], box.max[1]);
  ExtractionMatrix<degree> result(functions.size(), n_bernstein<degree>);
  for (std::size_t k = 0; k < functions.size(); ++k)
    {
      const auto &function = basis.function(functions[k]);
      const auto &along_u  = factors_u(function.knots[0]);
      const auto &along_v  = factors_v(function.knots[1]);
      for (int j = 0, b = 0; j <= degree; ++j)
        {
          const double factor = function.gamma * along_v[j];
          for (int i = 0; i <= degree; ++i, ++b)
            result(k, b) = factor * along_u[i];
        }
    }
  return result;
}

template ExtractionMatrix<2> extraction(const LRBasis<2> &, int);
template ExtractionMatrix<3> extraction(const LRBasis<3> &, int);
template ExtractionMatrix<4> extraction(const LRBasis<4> &, int);

} // namespace sherd
