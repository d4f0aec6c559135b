#pragma once

#include <array>
#include <vector>

#include <sherd/geometry/edge_geometry.h>
#include <sherd/geometry/surface.h>

namespace sherd
{

/// Part of an interface along which each side has one element.
struct InterfacePiece
{
  int                                  interface; ///< index into Surface::interfaces()
  std::array<int, 2>                   elements; ///< on the sides `first` and `second`, in the numbering of the surface
  std::array<std::array<double, 2>, 2> range; ///< [side]: parameters along it at start and end; start < end on `first`,
                                              ///< start > end on `second` of a reversed interface
};

/// The pieces of one interface, in the order of the parameter along its side `first`: the common refinement of the
/// elements of both sides.
template <int degree, int spacedim>
std::vector<InterfacePiece> interface_pieces(const Surface<degree, spacedim> &surface, int interface);

/// The pieces of all interfaces, in their order.
template <int degree, int spacedim>
std::vector<InterfacePiece> interface_pieces(const Surface<degree, spacedim> &surface);

/// A piece of an interface at degree+1 Gauss points, seen from both sides.
///
/// Derivatives and tangents of a side refer to the coordinates of its element, which run over [0,1]^2 in the directions
/// of the parameters of its patch, as in ShapeValues.
///
/// Source: theory G.1, G.2.
template <int degree, int spacedim>
struct InterfaceGeometry
{
  struct SidePoint
  {
    std::vector<double>   value;    ///< N_A, shape=(n_functions), in the order of points
    std::vector<double>   d1, d2;   ///< N_A,1  N_A,2, likewise
    Point<spacedim>       A1, A2;   ///< tangents X,1  X,2 of the reference surface
    std::array<double, 2> conormal; ///< nu^alpha, the outward unit conormal nu = nu^alpha A_alpha
    double                height;   ///< extent of the element normal to the interface, |A_1 x A_2| / |A_along| [length]
  };

  struct QuadraturePoint
  {
    Point<spacedim>          position; ///< X
    Point<spacedim>          tangent;  ///< unit tangent along the interface, as the parameter of side `first` grows
    double                   dS;       ///< reference length times the quadrature weight, [length]
    std::array<SidePoint, 2> side;     ///< `first`, `second`
  };

  struct SideElement
  {
    int              element;          ///< in the numbering of the surface
    int              normal_direction; ///< e: 0 on the sides u_min, u_max, 1 on v_min, v_max; 1 - e runs along
    int              outward;          ///< 1 at the maximum of coordinate e, -1 at its minimum
    std::vector<int> points; ///< control points of the element; those on the interface are in both sides' lists
  };

  InterfacePiece                          piece;
  std::array<SideElement, 2>              sides; ///< `first`, `second`
  std::array<QuadraturePoint, degree + 1> quadrature;

  /// Length of the piece on the reference surface.
  double length() const
  {
    double sum = 0.;
    for (const auto &q : quadrature)
      sum += q.dS;
    return sum;
  }
};

/// Geometry of one piece.
template <int degree, int spacedim>
InterfaceGeometry<degree, spacedim> interface_geometry(const Surface<degree, spacedim> &surface,
                                                       const InterfacePiece            &piece);

/// Geometry of all pieces of an interface.
template <int degree, int spacedim>
std::vector<InterfaceGeometry<degree, spacedim>> interface_geometry(const Surface<degree, spacedim> &surface,
                                                                    int                              interface)
{
  std::vector<InterfaceGeometry<degree, spacedim>> result;
  for (const auto &piece : interface_pieces(surface, interface))
    result.push_back(interface_geometry(surface, piece));
  return result;
}

} // namespace sherd

#include <sherd/geometry/interface_geometry.templates.h>
