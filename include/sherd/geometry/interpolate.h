#pragma once

#include <concepts>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>

#include <sherd/geometry/surface.h>

namespace sherd
{

/// Callable (u, v) -> X, a vector of spacedim components.
template <class Map, int spacedim>
concept PositionMap = std::invocable<const Map &, double, double> &&
                      std::decay_t<std::invoke_result_t<const Map &, double, double>>::RowsAtCompileTime == spacedim;

/// Callable (u, v) -> (w X, w), a vector of spacedim + 1 components with w > 0.
template <class Map, int spacedim>
concept HomogeneousMap = PositionMap<Map, spacedim + 1>;

/// Abscissae (k_{i+1} + ... + k_{i+degree}) / degree of the functions i of an open knot vector, ascending: one for each
/// function, inside its support.
template <int degree>
std::vector<double> greville_points(const std::vector<double> &knots);

/// Coefficients of the tensor-product spline that takes given values at the Greville points, solved direction by
/// direction.
/// @param values   row j n_u + i at Greville points i along u and j along v, any number of columns
/// @return         coefficients, same shape and order (that of LRBasis)
/// @throws DimensionMismatch   another number of rows
template <int degree>
Eigen::MatrixXd interpolation_coefficients(const std::vector<double> &knots_u, const std::vector<double> &knots_v,
                                           const Eigen::MatrixXd &values);

/// Names for the four sides of patch 0.
inline std::map<std::string, std::vector<Edge>> name_sides(const std::string &u_min, const std::string &u_max,
                                                           const std::string &v_min, const std::string &v_max)
{
  return {{u_min, {{0, Side::u_min}}},
          {u_max, {{0, Side::u_max}}},
          {v_min, {{0, Side::v_min}}},
          {v_max, {{0, Side::v_max}}}};
}

/// Surface of one patch on two open knot vectors that interpolates (u, v) -> (w X, w) at the Greville points, each of
/// the homogeneous components for itself.
///
/// Exact if all of them are polynomials of at most this degree in u and in v; otherwise of order degree + 1, and as
/// smooth as the knots allow. The sides depend on the values of the map there only, so that patches which share them
/// share their control points. Where the map gives the same w at all points, all weights are exactly this number.
///
/// Source: theory I, I.2.
/// @param map     called once for each Greville point inside the closed domain of the knots
/// @param edges   default: "left", "right" (u at its minimum, maximum), "bottom", "top" (the same of v)
/// @throws InvalidParameter   knots that are not open (LRBasis), a weight that is not positive
template <int degree, int spacedim, HomogeneousMap<spacedim> Map>
Surface<degree, spacedim>
interpolate(const std::vector<double> &knots_u, const std::vector<double> &knots_v, const Map &map,
            std::map<std::string, std::vector<Edge>> edges = name_sides("left", "right", "bottom", "top"))
{
  LRBasis<degree> basis(knots_u, knots_v);
  const auto      u = greville_points<degree>(knots_u), v = greville_points<degree>(knots_v);
  Eigen::MatrixXd values(u.size() * v.size(), spacedim + 1);
  for (std::size_t j = 0, k = 0; j < v.size(); ++j)
    for (std::size_t i = 0; i < u.size(); ++i, ++k)
      {
        const Point<spacedim + 1> point = map(u[i], v[j]);
        values.row(k)                   = point.transpose();
      }
  Eigen::VectorXd weights = values.col(spacedim);
  Eigen::MatrixXd c;
  if ((weights.array() == weights[0]).all())
    c = interpolation_coefficients<degree>(knots_u, knots_v, values.leftCols(spacedim)) / weights[0];
  else
    {
      c       = interpolation_coefficients<degree>(knots_u, knots_v, values);
      weights = c.col(spacedim);
      c       = weights.cwiseInverse().asDiagonal() * c;
    }
  using PatchType = Patch<degree, spacedim>;
  return Surface<degree, spacedim>(
      {PatchType{std::move(basis), ControlValues<spacedim>(c.leftCols(spacedim)), std::move(weights)}},
      std::move(edges));
}

/// The same for (u, v) -> X with all weights 1: a polynomial patch.
template <int degree, int spacedim, PositionMap<spacedim> Map>
Surface<degree, spacedim>
interpolate(const std::vector<double> &knots_u, const std::vector<double> &knots_v, const Map &map,
            std::map<std::string, std::vector<Edge>> edges = name_sides("left", "right", "bottom", "top"))
{
  const auto homogeneous = [&map](double u, double v) -> Point<spacedim + 1> {
    const Point<spacedim> X = map(u, v);
    return X.homogeneous();
  };
  return interpolate<degree, spacedim>(knots_u, knots_v, homogeneous, std::move(edges));
}

extern template std::vector<double> greville_points<2>(const std::vector<double> &);
extern template std::vector<double> greville_points<3>(const std::vector<double> &);
extern template std::vector<double> greville_points<4>(const std::vector<double> &);
extern template Eigen::MatrixXd interpolation_coefficients<2>(const std::vector<double> &, const std::vector<double> &,
                                                              const Eigen::MatrixXd &);
extern template Eigen::MatrixXd interpolation_coefficients<3>(const std::vector<double> &, const std::vector<double> &,
                                                              const Eigen::MatrixXd &);
extern template Eigen::MatrixXd interpolation_coefficients<4>(const std::vector<double> &, const std::vector<double> &,
                                                              const Eigen::MatrixXd &);

} // namespace sherd
