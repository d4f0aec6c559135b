#include <sherd/spline/evaluation.h>

namespace sherd
{

template <int degree>
std::vector<FunctionValue> evaluate(const LRBasis<degree> &basis, int e, double u, double v)
{
  const auto                &box = basis.element(e);
  std::vector<FunctionValue> result;
  result.reserve(basis.functions_of(e).size());
  for (const int i : basis.functions_of(e))
    {
      const auto &[knots, gamma] = basis.function(i);
      const auto a               = evaluate_piece<degree>(knots[0], span_index<degree>(knots[0], box.min[0]), u);
      const auto b               = evaluate_piece<degree>(knots[1], span_index<degree>(knots[1], box.min[1]), v);
      result.push_back({gamma * a.value * b.value,
                        {gamma * a.first * b.value, gamma * a.value * b.first},
                        {gamma * a.second * b.value, gamma * a.value * b.second, gamma * a.first * b.first}});
    }
  return result;
}

template std::vector<FunctionValue> evaluate(const LRBasis<2> &, int, double, double);
template std::vector<FunctionValue> evaluate(const LRBasis<3> &, int, double, double);
template std::vector<FunctionValue> evaluate(const LRBasis<4> &, int, double, double);

} // namespace sherd
