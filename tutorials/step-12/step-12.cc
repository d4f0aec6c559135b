// Step 12: your own weak form and your own solver loop
//
// No shell, no crack: an equation that the library does not know, on a curved surface that moves nowhere. A cap on a
// sphere shrinks because its border is curved. New here: the low rooms by themselves. The element kernel, the element
// loop, Newton's method and the refinement are all in this file.
// Run:     ./step-12 demo.yaml --output output-demo
//          mpirun -np 3 ./step-12 quick.yaml
// Expect:  history.csv and frames in the output directory; pictures by doc/figures output-demo
// Units:   none; the sphere has radius 1
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>

#include <sherd/algebra/linear_solver.h>
#include <sherd/assembly/scatter.h>
#include <sherd/base/collective.h>
#include <sherd/base/output_directory.h>
#include <sherd/base/parameters.h>
#include <sherd/geometry/element_geometry.h>
#include <sherd/geometry/shapes/sphere.h>
#include <sherd/output/csv_table.h>
#include <sherd/output/frames.h>
#include <sherd/space/shell_space.h>
#include <sherd/verify/derivative.h>

using namespace sherd;

namespace step_12
{

struct Parameters
{
  int    elements = 8;
  int    levels   = 3;
  double width    = .05;
  double angle    = 60.;
  double step     = 1e-3;
  double end      = .6;
  int    frames   = 12;

  void declare(ParameterSection &section)
  {
    section.value("elements", elements, range::at_least(1), "elements along the side of each of the six patches");
    section.value("levels", levels, range::closed(0, 8), "how often elements at the border are halved");
    section.value("width", width, "-", range::positive(), "length eps that the border is wide");
    section.value("angle", angle, "degrees", range::open(0., 90.), "initial polar angle of the border");
    section.value("step", step, "-", range::positive(), "time step");
    section.value("end", end, "-", range::positive(), "end of the run; the cap vanishes at -ln cos(angle)");
    section.value("frames", frames, range::at_least(1), "pictures of the run, evenly spaced in time");
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// 1. The weak form on one element.
//
// Allen and Cahn's equation phi_t = lap phi - W'(phi) / eps^2 with W = phi^2 (1 - phi)^2 lets phi fall to 0 or 1 and
// draws in the border between. One step from b to a, with mean values of a gradient and the difference quotient D of W:
//
//   int [ (a - b)/dt N + grad (a + b)/2 . grad N + D(a, b)/eps^2 N ] dA = 0   for all N,
//   D(a, b) = (W(a) - W(b)) / (a - b) = (1 - a - b) (a (1 - a) + b (1 - b)).
//
// With N = a - b it says that the energy E = int [ |grad phi|^2 / 2 + W / eps^2 ] dA falls by exactly |a - b|^2 / dt,
// whatever the step. The program prints how exactly: a kernel with a mistake would not do that.
//
// An element has the coordinates [0,1]^2 and (degree+1)^2 Bernstein functions, however many splines act on it: loops
// have fixed length, and nothing of the mesh is known here. A^ab is the inverse metric of the surface, stored as
// (11, 22, 12) (doc/notation.md); grad phi . grad N = A^ab phi,a N,b.
// ---------------------------------------------------------------------------------------------------------------------
constexpr int degree = 2;
using Element        = ElementGeometry<degree, 3>;
using Coefficients   = Eigen::Matrix<double, Element::n_b, 1>; // of a field on one element, by Bernstein functions
using Table          = Eigen::Matrix<double, Element::n_b, Element::n_b>;

struct ElementEquation
{
  Coefficients residual = Coefficients::Zero();
  Table        tangent  = Table::Zero(); // derivative of the residual by a
};

ElementEquation allen_cahn(const Element &element, const Coefficients &b, const Coefficients &a, double dt, double eps)
{
  ElementEquation                    result;
  std::optional<ShapeValues<degree>> storage;
  const auto                        &shapes = element.shapes(storage); // rational here: divided by the weight function
  for (int q = 0; q < Element::n_q; ++q)
    {
      const auto &A  = element.reference[q].contravariant;
      const auto  dA = element.reference[q].dA; // the weight of quadrature is inside
      const auto  N  = Eigen::Map<const Coefficients>(shapes.value[q].data());
      const auto  N1 = Eigen::Map<const Coefficients>(shapes.d1[q].data());
      const auto  N2 = Eigen::Map<const Coefficients>(shapes.d2[q].data());

      const Coefficients mean = .5 * (a + b);
      const double       now = N.dot(a), before = N.dot(b), m1 = N1.dot(mean), m2 = N2.dot(mean);
      const double       sum = now * (1. - now) + before * (1. - before), skew = 1. - now - before;
      const double       force = (now - before) / dt + skew * sum / (eps * eps);
      const double       slope = 1. / dt + (skew * (1. - 2. * now) - sum) / (eps * eps);

      result.residual += dA * (force * N + (A[0] * m1 + A[2] * m2) * N1 + (A[2] * m1 + A[1] * m2) * N2);
      result.tangent +=
          dA * (slope * N * N.transpose() + .5 * (A[0] * N1 * N1.transpose() + A[1] * N2 * N2.transpose() +
                                                  A[2] * (N1 * N2.transpose() + N2 * N1.transpose())));
    }
  return result;
}

// Energy, area where phi = 1, and the square of a difference of fields, of one element.
struct Measures
{
  double energy = 0., area = 0., square = 0.;
};

Measures measure(const Element &element, const Coefficients &phi, const Coefficients &difference, double eps)
{
  Measures                           sum;
  std::optional<ShapeValues<degree>> storage;
  const auto                        &shapes = element.shapes(storage);
  for (int q = 0; q < Element::n_q; ++q)
    {
      const auto  &A     = element.reference[q].contravariant;
      const auto   dA    = element.reference[q].dA;
      const auto   N     = Eigen::Map<const Coefficients>(shapes.value[q].data());
      const double value = N.dot(phi), change = N.dot(difference), well = value * (1. - value) / eps;
      const double phi_1 = Eigen::Map<const Coefficients>(shapes.d1[q].data()).dot(phi);
      const double phi_2 = Eigen::Map<const Coefficients>(shapes.d2[q].data()).dot(phi);
      sum.energy += dA * (.5 * (A[0] * phi_1 * phi_1 + A[1] * phi_2 * phi_2 + 2. * A[2] * phi_1 * phi_2) + well * well);
      sum.area += dA * value;
      sum.square += dA * change * change;
    }
  return sum;
}

// A kernel knows only its element, so it can be tested alone: is the tangent the derivative of the residual? Observed
// order 2 of the difference quotients says yes; a mistake gives order 0. Do this before anything else.
void check_kernel(const Element &element, double dt, double eps)
{
  Coefficients b, a, path;
  for (int i = 0; i < Element::n_b; ++i)
    {
      b[i]    = .5 + .4 * std::sin(1. + 3. * i);
      a[i]    = .5 + .5 * std::sin(2. + 5. * i);
      path[i] = std::cos(7. * i);
    }
  const auto check =
      verify::check_derivative([&](double h) { return allen_cahn(element, b, a + h * path, dt, eps).residual; },
                               Coefficients(allen_cahn(element, b, a, dt, eps).tangent * path));
  if (!check.passed())
    throw Error("step-12: the tangent is not the derivative of the residual: order " + print(check.order) +
                ", defect " + print(check.smallest_defect));
}

// ---------------------------------------------------------------------------------------------------------------------
// 2. The element loop.
//
// Every rank knows the surface; the unknowns are distributed. A rank owns some control points and visits every element
// that touches one of them ("active"). It fills the rows of its own points and drops the rest, which another rank
// computes too: nothing is exchanged. ShellSpace makes this partition; that a shell would have four unknowns a control
// point is not its business, we take one.
// ---------------------------------------------------------------------------------------------------------------------
struct Discretisation
{
  ShellSpace<degree, 3>               space;
  std::shared_ptr<const Distribution> points; // owned control points, then copies of others'
  std::vector<Element>                elements;
  ScatterMap                          scatter; // where the entries of an element lie in the rows of the matrix

  // A scalar second-order equation asks for nothing where patches meet, so no continuity beyond that of the values.
  Discretisation(const Environment &env, const Surface<degree, 3> &surface)
      : space(env, surface, continuity::None{}),
        points(
            std::make_shared<const Distribution>(env.comm(), space.distribution().owned, space.distribution().ghosts)),
        scatter(space.distribution())
  {
    for (const int e : space.distribution().elements)
      elements.push_back(element_geometry(surface, e));
  }

  Vector make_field() const { return Vector(points, 1); }

  // Control values become Bernstein coefficients by the extraction operator E of the element, c_b = sum_i E_ib c_i ...
  Coefficients on_element(std::size_t e, const Vector &field) const
  {
    Coefficients c = Coefficients::Zero();
    const auto   p = space.points_of(static_cast<int>(e));
    for (std::size_t i = 0; i < p.size(); ++i)
      c += field.local()[p[i]] * elements[e].extraction.row(i).transpose();
    return c;
  }

  // ... and residual and tangent return by its transpose.
  void assemble(const Vector &b, const Vector &a, double dt, double eps, Vector &residual, Matrix &matrix) const
  {
    residual.fill(0.);
    matrix.set_zero();
    for (std::size_t e = 0; e < elements.size(); ++e)
      {
        const auto            equation = allen_cahn(elements[e], on_element(e, b), on_element(e, a), dt, eps);
        const auto           &E        = elements[e].extraction;
        const Eigen::VectorXd r        = E * equation.residual;
        const Eigen::MatrixXd K        = E * equation.tangent * E.transpose();
        const auto            p        = space.points_of(static_cast<int>(e));
        const auto            at       = scatter.positions(static_cast<int>(e));
        const auto            n        = p.size();
        for (std::size_t i = 0; i < n; ++i)
          if (p[i] < points->n_owned())
            {
              residual.local()[p[i]] += r[i];
              for (std::size_t j = 0; j < n; ++j)
                matrix.values()[matrix.row_start(p[i]) + at[i * n + j]] += K(i, j);
            }
      }
  }

  // Of elements that are active on several ranks one is the owner's, and only that counts in a sum over all ranks.
  Measures measures(const Vector &phi, const Vector &difference, double eps) const
  {
    Measures sum;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (space.distribution().owns[e])
        {
          const auto part = measure(elements[e], on_element(e, phi), on_element(e, difference), eps);
          sum.energy += part.energy;
          sum.area += part.area;
          sum.square += part.square;
        }
    double values[] = {sum.energy, sum.area, sum.square};
    MPI_Allreduce(MPI_IN_PLACE, values, 3, MPI_DOUBLE, MPI_SUM, points->comm());
    return {values[0], values[1], values[2]};
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// 3. Newton's method, in ten lines. The linear solver is that of the shells (GMRES, incomplete factors), with blocks of
// one unknown.
// ---------------------------------------------------------------------------------------------------------------------
struct Iterations
{
  int newton = 0, linear = 0;
};

Iterations take_step(const Discretisation &d, LinearSolver &solver, const Vector &old, Vector &phi, double dt,
                     double eps)
{
  Iterations n;
  Matrix     matrix(d.points, d.space.distribution().graph, 1);
  Vector     residual = d.make_field(), increment = d.make_field();
  for (double change = 1.; change > 1e-10; ++n.newton)
    {
      if (n.newton == 20)
        throw NoConvergence("step-12: Newton's method stands at an increment of " + print(change) +
                            " after 20 iterations; try a smaller step");
      d.assemble(old, phi, dt, eps, residual, matrix);
      n.linear += solver.solve(matrix, residual, increment).iterations;
      axpy(-1., increment, phi);
      change = norm(increment) / std::sqrt(static_cast<double>(d.points->n_global()));
    }
  return n;
}

// ---------------------------------------------------------------------------------------------------------------------
// 4. The mesh. Functions are marked by their control values, their knot spans halved (step-1), and the field goes
// along: c_new = T c_old, the same function.
// ---------------------------------------------------------------------------------------------------------------------
double polar_angle(const Point<3> &X)
{
  return std::acos(X[2] / X.norm());
}

// Before the first step the border is where the formula says, and the field is set anew on each mesh.
void refine_around_cap(Surface<degree, 3> &surface, const Parameters &prm)
{
  const double border = prm.angle * std::numbers::pi / 180.;
  for (int level = 1; level <= prm.levels; ++level)
    {
      const double     size = .5 * std::numbers::pi / prm.elements * std::ldexp(2., -level);
      const auto       X    = surface.control_points();
      std::vector<int> marked;
      for (int A = 0; A < X.rows(); ++A)
        if (std::abs(polar_angle(X.row(A).transpose()) - border) < 2. * prm.width + 1.5 * size)
          marked.push_back(A);
      surface.refine(marked, {{std::ldexp(1., -level), std::ldexp(1., -level)}}); // elements of a patch have length 1
    }
}

// Later the border shows in the control values. Returns whether the mesh has changed; @p values then fit the new one.
bool follow_border(Surface<degree, 3> &surface, Eigen::VectorXd &values, int levels)
{
  const int n = surface.n_elements();
  for (int before = 0; before < surface.n_elements();)
    {
      std::vector<int> marked;
      for (int A = 0; A < values.size(); ++A)
        if (values[A] > .05 && values[A] < .95)
          marked.push_back(A);
      before = surface.n_elements();
      values = surface.refine(marked, {{std::ldexp(1., -levels), std::ldexp(1., -levels)}}).transfer.apply(values);
    }
  return surface.n_elements() > n;
}

void shrink_cap(const Environment &env, const Parameters &prm)
{
  refuse_restart(env);
  OutputDirectory directory(env);
  if (env.command_line().check)
    return;

  // Six quadratic NURBS patches. A border line that crosses from one to the next does not notice.
  auto sphere = shapes::sphere<degree>(1., prm.elements);
  refine_around_cap(sphere, prm);
  std::optional<Discretisation> d(std::in_place, env, sphere);
  check_kernel(d->elements.front(), prm.step, prm.width);

  // The profile across a straight border at rest is (1 + tanh(r / (sqrt(2) eps))) / 2. Control values taken from it at
  // the control points make a field that is close to it (second order).
  Vector     phi = d->make_field();
  const auto X   = sphere.control_points();
  for (int A = 0; A < d->points->n_local(); ++A)
    {
      const double distance = prm.angle * std::numbers::pi / 180. -
                              polar_angle(X.row(static_cast<Eigen::Index>(d->points->global(A))).transpose());
      phi.local()[A] = .5 * (1. + std::tanh(distance / (std::sqrt(2.) * prm.width)));
    }

  directory.prepare();
  write_parameters(env, directory.file("used.yaml"), prm);
  std::optional<CsvTable>    history; // rank 0 writes
  std::optional<FrameWriter> frames;
  on_root(env.comm(), [&] {
    history.emplace(directory.file("history.csv"),
                    std::vector<std::string>{"step", "time", "newton", "linear", "elements", "unknowns", "angle",
                                             "sharp_angle", "length", "energy", "balance"});
    frames.emplace(directory.path());
  });
  const auto write_frame = [&](double time) {
    const auto values = gather(phi);
    on_root(env.comm(), [&] {
      const auto n = static_cast<Eigen::Index>(values.size());
      frames->write(sphere, {time, sphere.control_points(), ControlValues<3>::Zero(n, 3),
                             Eigen::Map<const Eigen::VectorXd>(values.data(), n)});
    });
  };

  // What theory says of a thin border: it moves by its geodesic curvature, here cot(theta), so that
  // cos(theta) = cos(theta_0) e^t. The angle is measured by the area of the cap, 2 pi (1 - cos(theta)), the length of
  // the border by its energy, sqrt(2) / (6 eps) a unit of length.
  const auto cosine  = [](const Measures &m) { return 1. - m.area / (2. * std::numbers::pi); };
  auto       present = d->measures(phi, phi, prm.width);
  const auto initial = cosine(present);

  LinearSolver solver({.tolerance = 1e-10});
  const int    n_steps = static_cast<int>(std::ceil(prm.end / prm.step * (1. - 1e-12)));
  write_frame(0.);
  for (int step = 1; step <= n_steps; ++step)
    {
      const double dt = prm.end / n_steps, time = step * dt;
      const Vector old        = phi;
      const auto   iterations = take_step(*d, solver, old, phi, dt, prm.width);

      Vector change = phi;
      axpy(-1., old, change);
      const double before = present.energy;
      present             = d->measures(phi, change, prm.width);
      on_root(env.comm(), [&] {
        const double degrees = 180. / std::numbers::pi;
        history->append(CsvRow() << step << time << iterations.newton << iterations.linear << sphere.n_elements()
                                 << static_cast<int>(d->points->n_global()) << std::acos(cosine(present)) * degrees
                                 << std::acos(std::min(1., initial * std::exp(time))) * degrees
                                 << present.energy * 6. * prm.width / std::sqrt(2.) << present.energy
                                 << (present.energy - before + present.square / dt) / before);
      });

      // Replicated values refine a replicated surface; what is distributed is built anew and takes its part.
      const auto      all    = gather(phi);
      Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
      if (follow_border(sphere, values, prm.levels))
        {
          d.emplace(env, sphere);
          phi = d->make_field();
          scatter(std::span<const double>(values.data(), static_cast<std::size_t>(values.size())), phi);
          solver.forget();
        }
      if (step * prm.frames / n_steps > (step - 1) * prm.frames / n_steps)
        write_frame(time);
    }
  on_root(env.comm(), [&] {
    std::cout << n_steps << " steps, " << d->points->n_global() << " unknowns; border at "
              << std::acos(cosine(present)) * 180. / std::numbers::pi << " degrees, a thin one would be at "
              << std::acos(std::min(1., initial * std::exp(prm.end))) * 180. / std::numbers::pi << std::endl;
  });
}

} // namespace step_12

int main(int argc, char **argv)
{
  return run<step_12::Parameters>(argc, argv, step_12::shrink_cap);
}
