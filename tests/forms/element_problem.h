#pragma once

#include <geometry/sample_surfaces.h>
#include <sherd/forms/element_energies.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/surface_stretch.h>

namespace sherd::test
{

template <class Degradation, class Density, template <class, class> class Split, int degree = 2>
using Membrane = BrittleShell<degree, 2, Split<material::NeoHooke, material::NoBending>, Degradation, Density>;

/// Every choice meets every other one once.
using CubicFourthStretch     = Membrane<degradation::Cubic, crack_density::FourthOrder, split::SurfaceStretch>;
using QuadraticSecondStretch = Membrane<degradation::Quadratic, crack_density::SecondOrder, split::SurfaceStretch>;
using CubicSecondNone        = Membrane<degradation::Cubic, crack_density::SecondOrder, split::None>;
using QuadraticFourthNone    = Membrane<degradation::Quadratic, crack_density::FourthOrder, split::None>;
/// Splines of degree 3.
using CubicFourthStretch3 = Membrane<degradation::Cubic, crack_density::FourthOrder, split::SurfaceStretch, 3>;

/// Moduli and densities of order 1; the toughness varies in space.
template <class Model>
Model sample_model()
{
  return Model(decltype(Model::split)(material::NeoHooke(2.1, 1.3)), decltype(Model::degradation)(), {},
               Toughness<2>([](const Point<2> &X) { return 1.1 + .3 * X[0] * X[1]; }), .4, 1.7);
}

enum class Shape
{
  distorted,
  overloaded, ///< LR element of more than (degree + 1)^2 functions
  rational
};

/// Surface with elements of size about 1.
template <int degree>
Surface<degree, 2> sample_surface(Shape shape)
{
  if (shape == Shape::rational)
    {
      // A quarter of an annulus, then weights that vary in both directions.
      auto annulus = quarter_annulus<degree, 2>(1., 3.);
      refine_everywhere(annulus, 1);
      auto         patch = annulus.patch(0);
      std::mt19937 random(23);
      for (auto &weight : patch.weights)
        weight *= 1. + .2 * symmetric(random);
      return {{std::move(patch)}, annulus.edges()};
    }
  auto plate = distorted(shapes::plate<degree, 2>({4., 4.}, {4, 4}), .15);
  if (shape == Shape::overloaded)
    refine_at_random(plate, 2, 3, 73);
  return plate;
}

/// Unknowns of one element by control point, y[A * 3 + c]: position x, y and phase.
///
/// Forces and matrices come back in the same numbering, through the extraction operator.
template <class Model>
class ElementProblem
{
public:
  static constexpr int n_b = ElementFields<Model>::n_b, n_q = ElementData<Model>::n_q, n_fields = Model::n_fields;
  using History = std::array<double, n_q>;

  ElementProblem(const Model &model_, const Surface<Model::degree, 2> &surface, int element)
      : model(model_), data(element_data(model, surface, element)), X(data.geometry.points.size(), 2)
  {
    for (int A = 0; A < n_points(); ++A)
      X.row(A) = surface.control_points().row(data.geometry.points[A]);
  }

  int n_points() const { return static_cast<int>(data.geometry.points.size()); }

  /// x = F X + random, phase between .3 and .9.
  Eigen::VectorXd deformed(const Eigen::Matrix2d &F, double disorder, unsigned seed) const
  {
    std::mt19937    random(seed);
    Eigen::VectorXd y(n_points() * n_fields);
    for (int A = 0; A < n_points(); ++A)
      {
        const Eigen::Vector2d x = F * X.row(A).transpose();
        for (int d = 0; d < 2; ++d)
          y[A * n_fields + d] = x[d] + disorder * symmetric(random);
        y[A * n_fields + 2] = .6 + .3 * symmetric(random);
      }
    return y;
  }

  ElementFields<Model> fields(const Eigen::VectorXd &y, const Eigen::VectorXd &rate) const
  {
    ElementFields<Model> f{};
    for (int A = 0; A < n_points(); ++A)
      for (int b = 0; b < n_b; ++b)
        {
          const double E = data.geometry.extraction(A, b);
          for (int d = 0; d < 2; ++d)
            {
              f.position[d][b] += E * y[A * n_fields + d];
              f.acceleration[d][b] += E * rate[A * n_fields + d];
            }
          f.phase[b] += E * y[A * n_fields + 2];
        }
    return f;
  }
  ElementFields<Model> fields(const Eigen::VectorXd &y) const { return fields(y, Eigen::VectorXd::Zero(y.size())); }

  Eigen::VectorXd force(const Eigen::VectorXd &y, const History &history, const Eigen::VectorXd &acceleration) const
  {
    ElementVector<Model> f;
    element_force(model, data, fields(y, acceleration), history.data(), f);
    return on_points(f);
  }
  Eigen::VectorXd force(const Eigen::VectorXd &y, const History &history) const
  {
    return force(y, history, Eigen::VectorXd::Zero(y.size()));
  }

  struct Linearisation
  {
    Eigen::VectorXd force;
    Eigen::MatrixXd matrix;
  };

  Linearisation linearise(const Eigen::VectorXd &y, const History &history, double mass_weight = 0.,
                          PhaseTangent tangent = PhaseTangent::consistent) const
  {
    ElementVector<Model> f;
    ElementMatrix<Model> k;
    element_tangent(model, data, fields(y), history.data(), mass_weight, tangent, f, k);
    const Eigen::MatrixXd &E = data.geometry.extraction;
    Linearisation          result{on_points(f), Eigen::MatrixXd(y.size(), y.size())};
    for (int c = 0; c < n_fields; ++c)
      for (int d = 0; d < n_fields; ++d)
        {
          Eigen::MatrixXd block(n_b, n_b);
          for (int a = 0; a < n_b; ++a)
            for (int b = 0; b < n_b; ++b)
              block(a, b) = k.value[c * n_b + a][d * n_b + b];
          block = E * block * E.transpose();
          for (int A = 0; A < n_points(); ++A)
            for (int B = 0; B < n_points(); ++B)
              result.matrix(A * n_fields + c, B * n_fields + d) = block(A, B);
        }
    return result;
  }

  Energies energies(const Eigen::VectorXd &y, const Eigen::VectorXd &velocity) const
  {
    return element_energies(model, data, fields(y, velocity));
  }

  /// Work withheld in a step from the phase of @p before to that of @p y.
  double withheld_work(const Eigen::VectorXd &y, const Eigen::VectorXd &before, const History &history) const
  {
    return element_withheld_work(model, data, fields(y), fields(before).phase, history.data());
  }

  /// Elastic and fracture energy.
  double energy(const Eigen::VectorXd &y) const
  {
    const auto e = energies(y, Eigen::VectorXd::Zero(y.size()));
    return e.elastic() + e.fracture;
  }

  History active_energy(const Eigen::VectorXd &y) const { return element_active_energy(model, data, fields(y)); }

  double area() const
  {
    double sum = 0.;
    for (const auto &q : data.geometry.reference)
      sum += q.dA;
    return sum;
  }

  Model              model;
  ElementData<Model> data;
  ControlValues<2>   X; ///< control points of the element

private:
  Eigen::VectorXd on_points(const ElementVector<Model> &f) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(n_points() * n_fields);
    for (int A = 0; A < n_points(); ++A)
      for (int c = 0; c < n_fields; ++c)
        for (int b = 0; b < n_b; ++b)
          result[A * n_fields + c] += data.geometry.extraction(A, b) * f.value[c][b];
    return result;
  }
};

/// A problem on an element of the given shape, on LR meshes the one with the most functions.
template <class Model>
ElementProblem<Model> sample_problem(Shape shape)
{
  const auto surface = sample_surface<Model::degree>(shape);
  const int  element = shape == Shape::overloaded ? most_loaded_element(surface) : surface.n_elements() / 2;
  return {sample_model<Model>(), surface, element};
}

/// A deformation of surface stretch J with shear and a turn.
inline Eigen::Matrix2d deformation(double J)
{
  Eigen::Matrix2d F;
  F << 1.05, .12, -.07, (1. - .0084) / 1.05;
  return std::sqrt(J) * Eigen::Rotation2Dd(.7).toRotationMatrix() * F;
}

} // namespace sherd::test
