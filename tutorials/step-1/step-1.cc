// Step 1: splines that can be refined locally
//
// No mechanics yet. A tensor mesh is refined along a curve, a field is carried along, and single basis functions are
// drawn. New here: LR B-splines, the space of all later steps.
// Run:     ./step-1 demo.yaml --output output-demo            (a second)
//          mpirun -np 3 ./step-1 quick.yaml
// Expect:  levels.csv, functions.csv, frames in the output directory; pictures by doc/figures output-demo
// Units:   one unit of length is one element of the initial mesh
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>
#include <optional>
#include <set>

#include <sherd/base/collective.h>
#include <sherd/base/formula.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/fracture/polyline.h>
#include <sherd/geometry/bezier_element.h>
#include <sherd/geometry/shapes.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/spline/evaluation.h>
#include <sherd/spline/independence.h>

using namespace sherd;

namespace step_1
{

struct Parameters
{
  int                   degree   = 2;
  std::array<int, 2>    elements = {12, 10};
  int                   levels   = 4;
  std::vector<Point<2>> curve    = {{0., 4.}, {4., 4.}, {7., 5.5}, {8.5, 7.5}};
  Formula               field    = Formula("sin(0.9 * x) * cos(0.6 * y)", {"x", "y"});

  void declare(ParameterSection &section)
  {
    section.choice("degree", degree, {{"2", 2}, {"3", 3}, {"4", 4}}, "degree of the splines in both directions");
    section.value("elements", elements, range::at_least(1), "elements of the initial mesh, and the size of the plate");
    section.value("levels", levels, range::closed(0, 8), "how often the mesh is refined along the curve");
    section.value("curve", curve, "-", range::any(), "corners of the curve, a polyline");
    section.value("field", field, "-", "control values of the sample field, a formula of the position x, y");
  }
};

// What one rank writes. The basis is the same on every rank and refined alike; later steps distribute the unknowns.
struct Files
{
  CsvTable    levels, functions;
  FrameWriter frames;
};

// Points of the curve so close together that they visit every element it passes, also on the last level.
std::vector<Point<2>> points_of(const Polyline<2> &curve, double spacing)
{
  const auto           &corners = curve.points();
  std::vector<Point<2>> points{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i)
    {
      const Point<2> piece = corners[i] - corners[i - 1];
      const int      n     = static_cast<int>(std::ceil(piece.norm() / spacing));
      for (int k = 1; k <= n; ++k)
        points.push_back(corners[i - 1] + k * piece / n);
    }
  return points;
}

// Refinement is by functions, not by elements: a line that splits an element alone changes no spline, it has to cross
// the support of one from side to side (theory H.3, H.4). Control values of a phase field mark in the same way.
template <int degree>
std::vector<int> functions_along(const LRBasis<degree> &basis, const std::vector<Point<2>> &curve)
{
  std::set<int> marked;
  for (const auto &X : curve)
    {
      const auto functions = basis.functions_of(basis.element_at(X[0], X[1]));
      marked.insert(functions.begin(), functions.end());
    }
  return {marked.begin(), marked.end()};
}

// A field is sum_i c_i gamma_i B_i (theory H.1), here from the knots of each function by Cox and de Boor. Programs that
// integrate use the Bernstein form of a whole element instead, as bezier_element() does below.
template <int degree>
double evaluate_field(const LRBasis<degree> &basis, const Eigen::VectorXd &control_values, const Point<2> &X)
{
  const int  e      = basis.element_at(X[0], X[1]);
  const auto values = evaluate(basis, e, X[0], X[1]);
  double     sum    = 0.;
  for (std::size_t k = 0; k < values.size(); ++k)
    sum += control_values[basis.functions_of(e)[k]] * values[k].value;
  return sum;
}

// One row of levels.csv and one frame.
template <int degree>
void write_level(Files &files, int level, const Surface<degree, 2> &surface, const Eigen::VectorXd &field,
                 const Surface<degree, 2> &initial, const Eigen::VectorXd &initial_field)
{
  const auto &basis = surface.patch(0).basis;
  const auto &size  = initial.patch(0).basis.domain().max;

  // Two promises (theory H.2): the functions sum to one, and a refined field is the same function as before. The points
  // are compared with the initial field, so errors of all levels add up.
  constexpr int         n     = 50;
  const Eigen::VectorXd ones  = Eigen::VectorXd::Ones(basis.n_functions());
  double                unity = 0., change = 0.;
  for (int k = 0; k < n * n; ++k)
    {
      const Point<2> X((k % n + .5) / n * size[0], (k / n + .5) / n * size[1]);
      const auto     element = bezier_element<1>(surface.patch(0), basis.element_at(X[0], X[1]), field);
      unity                  = std::max(unity, std::abs(evaluate_field(basis, ones, X) - 1.));
      change =
          std::max(change, std::abs(element(X[0], X[1])[0] - evaluate_field(initial.patch(0).basis, initial_field, X)));
    }

  // An element of a tensor mesh has (degree+1)^2 functions, and that makes them independent. Here some have more; the
  // proof then goes function by function (theory H.5), and refine() throws if it should ever fail.
  const auto   independence = check_independence(basis);
  ElementField load{"functions", {}};
  for (int e = 0; e < basis.n_elements(); ++e)
    load.values.push_back(static_cast<double>(basis.functions_of(e).size()));
  double gamma = 1., uniform = 1.;
  for (int i = 0; i < basis.n_functions(); ++i)
    gamma = std::min(gamma, basis.function(i).gamma);
  for (int d = 0; d < 2; ++d)
    uniform *= std::ldexp(size[d], level) + degree;

  files.levels.append(CsvRow() << level << std::ldexp(1., -level) << basis.n_functions() << uniform
                               << basis.n_elements() << *std::max_element(load.values.begin(), load.values.end())
                               << static_cast<int>(independence.overloaded_elements.size())
                               << static_cast<int>(independence.overloaded_functions.size())
                               << static_cast<int>(independence.left_after_peeling.size()) << gamma << unity << change);
  files.frames.write(surface, {1. * level, surface.control_points(), ControlValues<2>::Zero(field.size(), 2), field},
                     {load});
  std::cout << "level " << level << ": " << basis.n_functions() << " functions, " << basis.n_elements()
            << " elements; unity to " << unity << ", field to " << change << std::endl;
}

// Three functions worth a look, each a frame of its own: the field whose only control value is 1.
template <int degree>
void write_functions(Files &files, const Surface<degree, 2> &surface)
{
  const auto &basis = surface.patch(0).basis;
  const auto  most  = [&](const auto &score) {
    std::vector<int> all(basis.n_functions());
    std::iota(all.begin(), all.end(), 0);
    return *std::max_element(all.begin(), all.end(), [&](int i, int j) { return score(i) < score(j); });
  };
  // A function knows degree + 2 knots a direction. Lines of its neighbours may end inside its support; then it has more
  // elements than cells between its own knots, and is a single polynomial on several of them.
  const auto n_elements = [&](int i) { return static_cast<int>(basis.elements_of(i).size()); };
  const auto n_cells    = [&](int i) {
    int n = 1;
    for (const auto &knots : basis.function(i).knots)
      n *= static_cast<int>(std::set<double>(knots.begin(), knots.end()).size()) - 1;
    return n;
  };
  const std::vector<std::pair<std::string, int>> chosen{
      {"regular", most([&](int i) { return n_elements(i) == n_cells(i) ? basis.function(i).support().area() : 0.; })},
      {"patchwork", most([&](int i) { return n_elements(i) - n_cells(i); })},
      {"lightest", most([&](int i) { return -basis.function(i).gamma; })}};
  for (const auto &[kind, i] : chosen)
    {
      CsvRow row;
      row << kind << files.frames.n_frames() << basis.function(i).gamma << n_cells(i) << n_elements(i);
      for (const auto &knots : basis.function(i).knots)
        {
          std::string text;
          for (const double knot : knots)
            text += print(knot) + " ";
          row << text;
        }
      files.functions.append(row);
      files.frames.write(surface, {1. * files.frames.n_frames(), surface.control_points(),
                                   ControlValues<2>::Zero(basis.n_functions(), 2),
                                   Eigen::VectorXd::Unit(basis.n_functions(), i)});
    }
}

// The degree is a template parameter throughout the library: it fixes the sizes of all element arrays.
template <int degree>
void refine_along_curve(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  OutputDirectory directory(env);
  const auto      curve = points_of(Polyline<2>(prm.curve), std::ldexp(.25, -prm.levels));

  // The size of the plate is its number of elements, so parameters and positions are the same numbers.
  const auto initial = shapes::plate<degree, 2>({1. * prm.elements[0], 1. * prm.elements[1]}, prm.elements);
  auto       surface = initial;
  auto       marked  = functions_along(surface.patch(0).basis, curve); // throws if the curve leaves the plate
  if (env.command_line().check)
    return;

  // A field with these control values is close to the formula (second order), and that is all we want of it here.
  const auto      X = initial.control_points();
  Eigen::VectorXd initial_field(X.rows());
  for (int i = 0; i < X.rows(); ++i)
    initial_field[i] = prm.field(X(i, 0), X(i, 1));
  auto field = initial_field;

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  std::optional<Files> files;
  on_root(env.comm(), [&] {
    files.emplace(Files{
        CsvTable(directory.file("levels.csv"),
                 {"level", "span", "functions", "uniform", "elements", "functions_per_element", "overloaded_elements",
                  "overloaded_functions", "left_after_peeling", "gamma", "unity", "change"}),
        CsvTable(directory.file("functions.csv"),
                 {"kind", "frame", "gamma", "cells", "elements", "knots_u", "knots_v"}),
        FrameWriter(directory.path())});
    write_level(*files, 0, surface, field, initial, initial_field);
  });
  for (int level = 1; level <= prm.levels; ++level)
    {
      // Halves every knot span of the marked functions that is longer than the target. The transfer matrix carries any
      // control values to the new functions: positive entries, rows that sum to one, no projection (theory H.2).
      const double target     = std::ldexp(1., -level);
      const auto   refinement = surface.refine(marked, {{target, target}});
      field                   = refinement.transfer.apply(field);
      marked                  = functions_along(surface.patch(0).basis, curve);
      on_root(env.comm(), [&] { write_level(*files, level, surface, field, initial, initial_field); });
    }
  on_root(env.comm(), [&] { write_functions(*files, surface); });
}

} // namespace step_1

int main(int argc, char **argv)
{
  // A program that offers several degrees decides here, once; everything above is compiled for each of them.
  return run<step_1::Parameters>(argc, argv, [](const Environment &env, const step_1::Parameters &prm) {
    if (prm.degree == 2)
      step_1::refine_along_curve<2>(env, prm);
    else if (prm.degree == 3)
      step_1::refine_along_curve<3>(env, prm);
    else
      step_1::refine_along_curve<4>(env, prm);
  });
}
