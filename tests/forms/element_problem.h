#pragma once

#include <optional>
#include <type_traits>

#include <forms/loaded_surfaces.h>
#include <sherd/forms/element_energies.h>
#include <sherd/forms/pressure.h>
#include <sherd/forms/shell_element.h>
#include <sherd/fracture/crack_density/fourth_order.h>
#include <sherd/fracture/crack_density/second_order.h>
#include <sherd/fracture/degradation/cubic.h>
#include <sherd/fracture/degradation/quadratic.h>
#include <sherd/material/shell_laws.h>
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

template <int degree, class Split, class Degradation, class Density>
using Shell = BrittleShell<degree, 3, Split, Degradation, Density>;

using StretchSplit = split::SurfaceStretch<material::NeoHooke, material::Canham>;
using WholeSplit   = split::None<material::NeoHooke, material::Canham>;
using KoiterSplit  = split::None<material::StVenantKirchhoff, material::Koiter>;

/// Shells: every choice of theirs meets every degree.
template <int degree>
using StretchShell = Shell<degree, StretchSplit, degradation::Cubic, crack_density::FourthOrder>;
template <int degree>
using WholeShell = Shell<degree, WholeSplit, degradation::Quadratic, crack_density::SecondOrder>;
template <int degree>
using KoiterShell = Shell<degree, KoiterSplit, degradation::Cubic, crack_density::FourthOrder>;

inline const material::Moduli sample_moduli{2.1, 1.3};

template <class Membrane>
auto sample_split(std::type_identity<split::None<Membrane>>, const LayerSettings &)
{
  return split::None<Membrane>(Membrane(sample_moduli));
}
template <class Membrane>
auto sample_split(std::type_identity<split::SurfaceStretch<Membrane>>, const LayerSettings &)
{
  return split::SurfaceStretch<Membrane>(Membrane(sample_moduli));
}
inline auto sample_split(std::type_identity<StretchSplit>, const LayerSettings &layers)
{
  return StretchSplit(material::NeoHooke(sample_moduli), material::Canham(.4), layers);
}
inline auto sample_split(std::type_identity<WholeSplit>, const LayerSettings &)
{
  return WholeSplit(material::NeoHooke(sample_moduli), material::Canham(.4));
}
inline auto sample_split(std::type_identity<KoiterSplit>, const LayerSettings &)
{
  return KoiterSplit(material::StVenantKirchhoff(sample_moduli), material::Koiter(sample_moduli, 1.2));
}

/// So thick that layers of sample deformations with J about 1 are cut, on elements of a tenth of the size as well.
inline LayerSettings thick_layers(Shape shape, Cut cut = Cut::frozen, LayerMetric metric = LayerMetric::full)
{
  return {.thickness = shape == Shape::overloaded ? .06 : .4, .metric = metric, .cut = cut};
}

/// Moduli and densities of order 1; the toughness varies in space.
/// @param layers   of splits that look into the thickness of a shell
template <class Model>
Model sample_model(const LayerSettings &layers = {.thickness = .3})
{
  constexpr int dim = Model::spacedim;
  return Model(sample_split(std::type_identity<decltype(Model::split)>(), layers), decltype(Model::degradation)(), {},
               Toughness<dim>([](const Point<dim> &X) { return 1.1 + .3 * X[0] * X[1]; }), .4, 1.7);
}

/// Surface with elements of size about 1, in space curved.
template <int degree, int spacedim>
Surface<degree, spacedim> sample_surface(Shape shape)
{
  if constexpr (spacedim == 3)
    return curved_surface<degree>(shape);
  else if (shape == Shape::rational)
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
  else
    {
      auto plate = distorted(shapes::plate<degree, 2>({4., 4.}, {4, 4}), .15);
      if (shape == Shape::overloaded)
        refine_at_random(plate, 2, 3, 73);
      return plate;
    }
}

/// Unknowns of one element by control point, y[A * n_fields + c]: the coordinates of the position, then the phase.
///
/// Forces and matrices come back in the same numbering, through the extraction operator. With a pressure they are those
/// of internal less external.
template <class Model>
class ElementProblem
{
public:
  static constexpr int n_b = ElementFields<Model>::n_b, n_q = ElementData<Model>::n_q;
  static constexpr int n_fields = Model::n_fields, dim = Model::spacedim;
  using History  = std::array<double, n_q>;
  using Gradient = Eigen::Matrix<double, dim, dim>;

  ElementProblem(const Model &model_, const Surface<Model::degree, dim> &surface, int element)
      : model(model_), data(element_data(model, surface, element)), X(data.geometry.points.size(), dim)
  {
    for (int A = 0; A < n_points(); ++A)
      X.row(A) = surface.control_points().row(data.geometry.points[A]);
  }

  int n_points() const { return static_cast<int>(data.geometry.points.size()); }

  /// x = F X + random, phase between .3 and .9.
  Eigen::VectorXd deformed(const Gradient &F, double disorder, unsigned seed) const
  {
    std::mt19937    random(seed);
    Eigen::VectorXd y(n_points() * n_fields);
    for (int A = 0; A < n_points(); ++A)
      {
        const Point<dim> x = F * X.row(A).transpose();
        for (int d = 0; d < dim; ++d)
          y[A * n_fields + d] = x[d] + disorder * symmetric(random);
        y[A * n_fields + dim] = .6 + .3 * symmetric(random);
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
          for (int d = 0; d < dim; ++d)
            {
              f.position[d][b] += E * y[A * n_fields + d];
              f.acceleration[d][b] += E * rate[A * n_fields + d];
            }
          f.phase[b] += E * y[A * n_fields + dim];
        }
    return f;
  }
  ElementFields<Model> fields(const Eigen::VectorXd &y) const { return fields(y, Eigen::VectorXd::Zero(y.size())); }

  Eigen::VectorXd force(const Eigen::VectorXd &y, const History &history, const Eigen::VectorXd &acceleration) const
  {
    ElementVector<Model> f;
    element_force(model, data, fields(y, acceleration), history.data(), f);
    Eigen::VectorXd total = on_points(f);
    if constexpr (dim == 3)
      if (pressure)
        {
          f = {};
          add_pressure(data, fields(y), *pressure, f);
          total -= on_points(f);
        }
    return total;
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
    if constexpr (dim == 3)
      if (pressure)
        add_pressure_tangent(data, fields(y), *pressure, k);
    const Eigen::MatrixXd &E = data.geometry.extraction;
    Linearisation          result{pressure ? force(y, history) : on_points(f), Eigen::MatrixXd(y.size(), y.size())};
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
    return element_withheld_work(model, data, fields(y).phase, fields(before).phase, history.data(),
                                 active_energy(y).data());
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

  /// Deformation at a quadrature point.
  SurfacePoint<dim> point(const Eigen::VectorXd &y, int q) const
  {
    std::optional<ShapeValues<Model::degree>> storage;
    const auto                               &s = data.geometry.shapes(storage);
    return surface_point(data.reference[q], surface_frame(FieldInterpolation<Model>(fields(y)).at(s, q)));
  }

  Model                                 model;
  ElementData<Model>                    data;
  ControlValues<dim>                    X; ///< control points of the element
  std::optional<ElementPressure<Model>> pressure;

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
ElementProblem<Model> sample_problem(Shape shape, const LayerSettings &layers = {.thickness = .3})
{
  const auto surface = sample_surface<Model::degree, Model::spacedim>(shape);
  const int  element = shape == Shape::overloaded ? most_loaded_element(surface) : surface.n_elements() / 2;
  return {sample_model<Model>(layers), surface, element};
}

/// A deformation of surface stretch J with shear and a turn, in space about no axis of the frame.
template <int spacedim = 2>
Eigen::Matrix<double, spacedim, spacedim> deformation(double J)
{
  Eigen::Matrix2d F;
  F << 1.05, .12, -.07, (1. - .0084) / 1.05;
  F *= std::sqrt(J);
  if constexpr (spacedim == 2)
    return Eigen::Rotation2Dd(.7).toRotationMatrix() * F;
  else
    {
      Eigen::Matrix3d G       = std::sqrt(J) * Eigen::Matrix3d::Identity();
      G.topLeftCorner<2, 2>() = F;
      return rotation() * G;
    }
}

/// History of the past of a point relative to its present active energy.
enum class Past
{
  loading,   ///< no history anywhere
  unloading, ///< history above the present energy everywhere
  both       ///< in turn
};

template <class Problem>
typename Problem::History past_history(const Problem &problem, const Eigen::VectorXd &y, Past past)
{
  auto history = problem.active_energy(y);
  for (std::size_t q = 0; q < history.size(); ++q)
    history[q] = past == Past::loading || (past == Past::both && q % 2 == 0) ? 0. : 3. * history[q];
  return history;
}

inline Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed)
{
  std::mt19937    random(seed);
  Eigen::VectorXd v(n);
  for (auto &value : v)
    value = symmetric(random);
  return v;
}

/// Which of the unknowns: the displacements or the phase.
enum class Part
{
  u,
  phi
};

/// The part of a vector by control points, zero elsewhere.
template <int spacedim>
Eigen::VectorXd only(Part part, Eigen::VectorXd y)
{
  for (Eigen::Index i = 0; i < y.size(); ++i)
    if ((i % (spacedim + 1) == spacedim) != (part == Part::phi))
      y[i] = 0.;
  return y;
}

} // namespace sherd::test
