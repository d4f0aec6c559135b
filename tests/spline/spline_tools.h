#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include <sherd/spline/evaluation.h>
#include <sherd/spline/lr_basis.h>

namespace sherd::test
{

/// Open knot vector with the given distinct values, inner ones once.
inline std::vector<double> open_knots(int degree, std::vector<double> values)
{
  values.insert(values.begin(), degree, values.front());
  values.insert(values.end(), degree, values.back());
  return values;
}

/// Open knot vector with knots 0, 1, ..., n.
inline std::vector<double> integer_knots(int degree, int n)
{
  std::vector<double> values;
  for (int i = 0; i <= n; ++i)
    values.push_back(i);
  return open_knots(degree, values);
}

/// B-spline by the textbook recurrence of Cox and de Boor, half-open.
inline double cox_de_boor(const double *knots, int degree, double x)
{
  if (degree == 0)
    return knots[0] <= x && x < knots[1] ? 1. : 0.;
  double value = 0.;
  if (knots[degree] > knots[0])
    value += (x - knots[0]) / (knots[degree] - knots[0]) * cox_de_boor(knots, degree - 1, x);
  if (knots[degree + 1] > knots[1])
    value += (knots[degree + 1] - x) / (knots[degree + 1] - knots[1]) * cox_de_boor(knots + 1, degree - 1, x);
  return value;
}

/// Derivative of the given order of a B-spline, by differences of B-splines of lower degree.
inline double cox_de_boor_derivative(const double *knots, int degree, double x, int order)
{
  if (order == 0)
    return cox_de_boor(knots, degree, x);
  double value = 0.;
  if (knots[degree] > knots[0])
    value += degree / (knots[degree] - knots[0]) * cox_de_boor_derivative(knots, degree - 1, x, order - 1);
  if (knots[degree + 1] > knots[1])
    value -= degree / (knots[degree + 1] - knots[1]) * cox_de_boor_derivative(knots + 1, degree - 1, x, order - 1);
  return value;
}

/// Uniform number in [0, 1) that does not depend on the standard library.
inline double uniform(std::mt19937 &generator)
{
  return generator() / 4294967296.;
}

inline int uniform_int(std::mt19937 &generator, int n)
{
  return static_cast<int>(generator() % static_cast<unsigned>(n));
}

/// A point inside element e.
inline std::array<double, 2> point_inside(const Box &box, std::mt19937 &generator)
{
  std::array<double, 2> point;
  for (int d = 0; d < 2; ++d)
    point[d] = box.min[d] + (0.02 + 0.96 * uniform(generator)) * (box.max[d] - box.min[d]);
  return point;
}

/// Random functions of the basis, each with the given chance.
template <int degree>
std::vector<int> random_functions(const LRBasis<degree> &basis, double chance, std::mt19937 &generator)
{
  std::vector<int> functions;
  for (int i = 0; i < basis.n_functions(); ++i)
    if (uniform(generator) < chance)
      functions.push_back(i);
  return functions;
}

/// A line in the middle of a random knot span of a random function, across its support and sometimes beyond it, into
/// the interior of elements.
template <int degree>
MeshLine random_line(const LRBasis<degree> &basis, int max_multiplicity, std::mt19937 &generator)
{
  for (;;)
    {
      const auto  &function = basis.function(uniform_int(generator, basis.n_functions()));
      const int    d        = uniform_int(generator, 2);
      const auto  &knots    = function.knots[d];
      const int    k        = uniform_int(generator, degree + 1);
      const double excess = 0.3 * uniform_int(generator, 2), start = function.knots[1 - d].front() - excess,
                   end       = function.knots[1 - d].back() + excess;
      const int multiplicity = 1 + uniform_int(generator, max_multiplicity);
      if (knots[k + 1] - knots[k] > 0.2)
        return {static_cast<Direction>(d), 0.5 * (knots[k] + knots[k + 1]), std::max(start, basis.domain().min[1 - d]),
                std::min(end, basis.domain().max[1 - d]), multiplicity};
    }
}

/// Field sum_i c_i gamma_i B_i of control data shape=(n_functions, n_columns): value, d/du, d/dv, d2/du2, d2/dv2,
/// d2/dudv in the rows.
template <int degree>
Eigen::MatrixXd field(const LRBasis<degree> &basis, const Eigen::MatrixXd &control, int e, double u, double v)
{
  Eigen::MatrixXd result    = Eigen::MatrixXd::Zero(6, control.cols());
  const auto      values    = evaluate(basis, e, u, v);
  const auto      functions = basis.functions_of(e);
  for (std::size_t k = 0; k < values.size(); ++k)
    {
      const auto  &f      = values[k];
      const double row[6] = {f.value, f.first[0], f.first[1], f.second[0], f.second[1], f.second[2]};
      for (int r = 0; r < 6; ++r)
        result.row(r) += row[r] * control.row(functions[k]);
    }
  return result;
}

/// Reproducible control data in [-1, 1], shape=(n, n_columns).
inline Eigen::MatrixXd random_control(int n, int n_columns, std::mt19937 &generator)
{
  Eigen::MatrixXd control(n, n_columns);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n_columns; ++j)
      control(i, j) = 2. * uniform(generator) - 1.;
  return control;
}

/// Functions with knots and weight in the order of the reference data: by knots along v, then along u.
template <int degree>
std::vector<LRFunction<degree>> sorted_functions(const LRBasis<degree> &basis)
{
  std::vector<LRFunction<degree>> functions;
  for (int i = 0; i < basis.n_functions(); ++i)
    functions.push_back(basis.function(i));
  std::sort(functions.begin(), functions.end(), [](const auto &a, const auto &b) {
    return std::tie(a.knots[1], a.knots[0]) < std::tie(b.knots[1], b.knots[0]);
  });
  return functions;
}

/// Elements in the order of the reference data: by lower end along v, then along u.
template <int degree>
std::vector<Box> sorted_elements(const LRBasis<degree> &basis)
{
  std::vector<Box> elements;
  for (int e = 0; e < basis.n_elements(); ++e)
    elements.push_back(basis.element(e));
  std::sort(elements.begin(), elements.end(),
            [](const Box &a, const Box &b) { return std::tie(a.min[1], a.min[0]) < std::tie(b.min[1], b.min[0]); });
  return elements;
}

/// Largest difference of the weights of two bases; infinite if their elements or the knots of their functions differ.
template <int degree>
double difference(const LRBasis<degree> &a, const LRBasis<degree> &b)
{
  const double infinity = std::numeric_limits<double>::infinity();
  if (a.mesh_lines() != b.mesh_lines() || sorted_elements(a) != sorted_elements(b) ||
      a.n_functions() != b.n_functions())
    return infinity;
  const auto of_a = sorted_functions(a), of_b = sorted_functions(b);
  double     result = 0.;
  for (std::size_t i = 0; i < of_a.size(); ++i)
    result = of_a[i].knots != of_b[i].knots ? infinity : std::max(result, std::abs(of_a[i].gamma - of_b[i].gamma));
  return result;
}

} // namespace sherd::test
