#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include <sherd/geometry/interface_geometry.h>

namespace sherd
{

namespace internal
{

/// Ends of the elements along a side, as marks: where the first starts and where each of them ends, ascending if the
/// marks count with the parameter, and the elements in the same order.
struct SideElements
{
  std::vector<SideRuler::Mark> marks;    ///< shape=(n + 1)
  std::vector<int>             elements; ///< shape=(n), in the numbering of the surface
};

template <int degree, int spacedim>
SideElements side_elements(const Surface<degree, spacedim> &surface, const Edge &edge, const SideRuler &ruler)
{
  const auto  &basis  = surface.patch(edge.patch).basis;
  const int    along  = 1 - normal_direction(edge.side);
  const int    offset = surface.element_offset(edge.patch);
  SideElements result;
  result.elements = elements_along(surface, edge);
  result.marks.push_back(ruler.mark(basis.domain().min[along]));
  for (const int e : result.elements)
    result.marks.push_back(ruler.mark(basis.element(e - offset).max[along]));
  if (result.marks.front() > result.marks.back())
    {
      std::reverse(result.marks.begin(), result.marks.end());
      std::reverse(result.elements.begin(), result.elements.end());
    }
  return result;
}

} // namespace internal

template <int degree, int spacedim>
std::vector<InterfacePiece> interface_pieces(const Surface<degree, spacedim> &surface, int interface)
{
  const auto &[first, second, reversed] = surface.interfaces()[interface];
  const std::array<internal::SideRuler, 2> rulers{
      internal::side_ruler(surface.patch(first.patch), first.side, false),
      internal::side_ruler(surface.patch(second.patch), second.side, reversed)};
  const std::array<internal::SideElements, 2> sides{internal::side_elements(surface, first, rulers[0]),
                                                    internal::side_elements(surface, second, rulers[1])};
  std::vector<internal::SideRuler::Mark>      ends;
  std::set_union(sides[0].marks.begin(), sides[0].marks.end(), sides[1].marks.begin(), sides[1].marks.end(),
                 std::back_inserter(ends));

  std::vector<InterfacePiece> pieces;
  std::array<std::size_t, 2>  at{0, 0};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    {
      auto &piece     = pieces.emplace_back();
      piece.interface = interface;
      for (int s = 0; s < 2; ++s)
        {
          if (sides[s].marks[at[s] + 1] <= ends[k])
            ++at[s];
          piece.elements[s] = sides[s].elements[at[s]];
          piece.range[s]    = {rulers[s].parameter(ends[k]), rulers[s].parameter(ends[k + 1])};
        }
    }
  return pieces;
}

template <int degree, int spacedim>
std::vector<InterfacePiece> interface_pieces(const Surface<degree, spacedim> &surface)
{
  std::vector<InterfacePiece> all;
  for (std::size_t k = 0; k < surface.interfaces().size(); ++k)
    for (const auto &piece : interface_pieces(surface, static_cast<int>(k)))
      all.push_back(piece);
  return all;
}

template <int degree, int spacedim>
InterfaceGeometry<degree, spacedim> interface_geometry(const Surface<degree, spacedim> &surface,
                                                       const InterfacePiece            &piece)
{
  const auto                         &interface = surface.interfaces()[piece.interface];
  const auto                         &gauss     = gauss_legendre(degree + 1);
  InterfaceGeometry<degree, spacedim> result;
  result.piece = piece;
  for (int s = 0; s < 2; ++s)
    {
      const Edge              &edge      = s == 0 ? interface.first : interface.second;
      const auto              &patch     = surface.patch(edge.patch);
      const int                normal    = internal::normal_direction(edge.side);
      const int                along     = 1 - normal;
      const int                local     = piece.elements[s] - surface.element_offset(edge.patch);
      const auto               functions = patch.basis.functions_of(local);
      const Box               &box       = patch.basis.element(local);
      ExtractionMatrix<degree> E         = extraction(patch.basis, local);
      ControlValues<spacedim>  control(functions.size(), spacedim);
      auto                    &side = result.sides[s];
      side.element                  = piece.elements[s];
      side.normal_direction         = normal;
      side.outward                  = internal::at_maximum(edge.side) ? 1 : -1;
      for (std::size_t k = 0; k < functions.size(); ++k)
        {
          side.points.push_back(surface.point(edge.patch, functions[k]));
          E.row(k) *= patch.weights[functions[k]];
          control.row(k) = patch.control_points.row(functions[k]);
        }
      const auto &[start, end] = piece.range[s];
      for (int q = 0; q <= degree; ++q)
        {
          std::array<double, 2> at;
          at[normal]  = side.outward > 0 ? 1. : 0.;
          at[along]   = (start + gauss.points[q] * (end - start) - box.min[along]) / box.size()[along];
          auto  found = internal::edge_point<degree, spacedim>(E, control, at[0], at[1]);
          auto &point = result.quadrature[q];

          const Point<spacedim>      &A_along = normal == 0 ? found.A2 : found.A1;
          const std::array<double, 3> A{found.A1.squaredNorm(), found.A2.squaredNorm(), found.A1.dot(found.A2)};
          const double                det = A[0] * A[1] - A[2] * A[2];
          if (s == 0)
            {
              point.position = found.position;
              point.tangent  = A_along.normalized();
              point.dS       = A_along.norm() * (end - start) / box.size()[along] * gauss.weights[q];
            }
          auto &seen = point.side[s];
          // nu^alpha = s A^{e alpha} / sqrt(A^{ee})
          const double raised_normal = A[along] / det;
          seen.conormal[normal]      = side.outward * std::sqrt(raised_normal);
          seen.conormal[along]       = -side.outward * A[2] / det / std::sqrt(raised_normal);
          seen.height                = std::sqrt(det) / A_along.norm();
          seen.A1                    = found.A1;
          seen.A2                    = found.A2;
          seen.value                 = std::move(found.value);
          seen.d1                    = std::move(found.d1);
          seen.d2                    = std::move(found.d2);
        }
    }
  return result;
}

} // namespace sherd
