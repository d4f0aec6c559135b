#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <sherd/base/exceptions.h>
#include <sherd/forms/fold_angle.h>
#include <sherd/geometry/interface_geometry.h>

namespace sherd
{

/// One piece of an interface between two elements as the forms of continuity see it: the control points of both
/// elements in one list, and what is linear in their values as tables over this list.
///
/// Indices 1 and 2 are the coordinates of each element on its own side of the interface.
template <int degree, int spacedim>
struct InterfaceTables
{
  static constexpr int n_q = degree + 1;

  struct QuadraturePoint
  {
    Point<spacedim>                          position; ///< X
    double                                   dS;       ///< reference length times the quadrature weight, [length]
    Eigen::VectorXd                          value;    ///< N_A on the interface, the same of both sides, shape=(n)
    Eigen::Matrix<double, 4, Eigen::Dynamic> slopes;   ///< N_A,1 N_A,2 of the first side, N_A,1 N_A,2 of the second
    Eigen::VectorXd jump;      ///< b_A = nu^a N_A,a of both sides, conormals outward [1/length], shape=(n)
    CosineSine      reference; ///< of the angle between the reference surfaces; spacedim 3
  };

  std::vector<int>                 points;     ///< control points of both elements, ascending, each once
  int                              along;      ///< coordinate of the first side that runs along the interface, 0 or 1
  double                           length = 0; ///< int dS [length]
  double                           size   = 0; ///< h: element size across the interface, the smaller of both sides'
  std::array<QuadraturePoint, n_q> quadrature;
};

namespace internal
{

/// Checks one row of @p values for each control point of a piece.
template <int degree, int spacedim, class Values>
void check_interface_values(const InterfaceTables<degree, spacedim> &piece, const Values &values)
{
  if (values.rows() != static_cast<Eigen::Index>(piece.points.size()))
    throw DimensionMismatch("interface: " + std::to_string(values.rows()) + " control values for a piece of " +
                            std::to_string(piece.points.size()) + " control points; expected one row a point");
}

/// Fold variables at quadrature point @p q of a piece with control points @p x, shape=(n, 3).
template <int degree>
FoldVariables fold_variables(const InterfaceTables<degree, 3> &piece, const ControlValues<3> &x, int q)
{
  FoldVariables y;
  y.leftCols<4>() = (piece.quadrature[q].slopes.lazyProduct(x)).transpose();
  y.col(4)        = y.col(piece.along);
  return y;
}

} // namespace internal

/// Tables of a piece. Control points that one side names twice, on a seam, add up.
template <int degree, int spacedim>
InterfaceTables<degree, spacedim> interface_tables(const InterfaceGeometry<degree, spacedim> &geometry)
{
  InterfaceTables<degree, spacedim> tables;
  auto                             &points = tables.points;
  for (const auto &side : geometry.sides)
    points.insert(points.end(), side.points.begin(), side.points.end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  tables.along = 1 - geometry.sides[0].normal_direction;

  double heights[2] = {0., 0.};
  for (int q = 0; q <= degree; ++q)
    {
      const auto &from = geometry.quadrature[q];
      auto       &to   = tables.quadrature[q];
      to.position      = from.position;
      to.dS            = from.dS;
      to.value         = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
      to.slopes        = Eigen::MatrixXd::Zero(4, static_cast<Eigen::Index>(points.size()));
      to.jump          = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(points.size()));
      tables.length += from.dS;
      for (int s = 0; s < 2; ++s)
        {
          const auto &side = from.side[s];
          heights[s] += from.dS * side.height;
          for (std::size_t k = 0; k < geometry.sides[s].points.size(); ++k)
            {
              const auto A =
                  std::lower_bound(points.begin(), points.end(), geometry.sides[s].points[k]) - points.begin();
              if (s == 0)
                to.value[A] += side.value[k];
              to.slopes(2 * s, A) += side.d1[k];
              to.slopes(2 * s + 1, A) += side.d2[k];
              to.jump[A] += side.conormal[0] * side.d1[k] + side.conormal[1] * side.d2[k];
            }
        }
      if constexpr (spacedim == 3)
        {
          FoldVariables Y;
          Y << from.side[0].A1, from.side[0].A2, from.side[1].A1, from.side[1].A2, from.tangent;
          to.reference = fold_angle(Y);
        }
    }
  tables.size = std::min(heights[0], heights[1]) / tables.length;
  return tables;
}

} // namespace sherd
