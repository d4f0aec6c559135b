#pragma once

#include <cmath>
#include <vector>

#include <sherd/spline/quadrature.h>
#include <sherd/state/state.h>

namespace sherd
{

/// Parameter boxes of all elements of a surface, shape=(n_elements). Taken before a refinement, for transfer().
template <int degree, int spacedim>
std::vector<Box> element_boxes(const Surface<degree, spacedim> &surface)
{
  std::vector<Box> boxes;
  for (int p = 0; p < surface.n_patches(); ++p)
    for (int e = 0; e < surface.patch(p).basis.n_elements(); ++e)
      boxes.push_back(surface.patch(p).basis.element(e));
  return boxes;
}

/// For each quadrature point of the interval [child_min, child_max] the nearest one of the interval that contains it,
/// shape=(degree+1). At equal distance the one further from the centre of the parent, so that mirrored children agree.
template <int degree>
std::array<int, degree + 1> nearest_quadrature_points(double parent_min, double parent_max, double child_min,
                                                      double child_max)
{
  const auto                 &gauss = gauss_legendre(degree + 1);
  std::array<int, degree + 1> nearest;
  for (int i = 0; i <= degree; ++i)
    {
      const double x = (child_min - parent_min + gauss.points[i] * (child_max - child_min)) / (parent_max - parent_min);
      int          best = 0;
      for (int k = 1; k <= degree; ++k)
        {
          const double gain = std::abs(x - gauss.points[best]) - std::abs(x - gauss.points[k]);
          if (gain > 1e-12 || (gain > -1e-12 && x > .5))
            best = k;
        }
      nearest[i] = best;
    }
  return nearest;
}

/// Multipliers on the pieces of a refined surface: each the value of the old piece that contains it.
inline Multipliers transfer(const Multipliers &old, std::vector<InterfacePiece> pieces)
{
  Multipliers result{std::move(pieces), {}};
  result.values.resize(static_cast<Eigen::Index>(result.pieces.size()), 3);
  std::size_t parent = 0;
  for (std::size_t k = 0; k < result.pieces.size(); ++k)
    {
      // Both lists are ordered by interface and parameter, and pieces are never joined.
      const auto &piece = result.pieces[k];
      while (parent + 1 < old.pieces.size() &&
             (old.pieces[parent].interface < piece.interface || old.pieces[parent].range[0][1] <= piece.range[0][0]))
        ++parent;
      result.values.row(static_cast<Eigen::Index>(k)) = old.values.row(static_cast<Eigen::Index>(parent));
    }
  return result;
}

/// Carries a state through a refinement: the control values exactly (they are the same functions), the history of each
/// new quadrature point from the nearest one of its parent element, multipliers from the piece that contains theirs.
///
/// @param boxes    of the old elements
/// @param surface  after the refinement
///
/// Source: theory D (transfer on refinement), F.4 3.
template <int degree, int spacedim>
GlobalState<degree, spacedim> transfer(const GlobalState<degree, spacedim> &old, const std::vector<Box> &boxes,
                                       const SurfaceRefinement &refinement, const Surface<degree, spacedim> &surface)
{
  using Global          = GlobalState<degree, spacedim>;
  Global result         = old;
  result.position       = refinement.transfer.apply(old.position);
  result.velocity       = refinement.transfer.apply(old.velocity);
  result.acceleration   = refinement.transfer.apply(old.acceleration);
  result.phase          = refinement.transfer.apply(old.phase);
  result.previous_phase = refinement.transfer.apply(old.previous_phase);

  if (!old.multipliers.pieces.empty())
    result.multipliers = transfer(old.multipliers, interface_pieces(surface));

  const auto children = element_boxes(surface);
  result.history.resize(children.size(), Global::n_q);
  for (std::size_t e = 0; e < children.size(); ++e)
    {
      const int   parent = refinement.parent[e];
      const auto &box    = boxes[parent];
      const auto &child  = children[e];
      const auto  u      = nearest_quadrature_points<degree>(box.min[0], box.max[0], child.min[0], child.max[0]);
      const auto  v      = nearest_quadrature_points<degree>(box.min[1], box.max[1], child.min[1], child.max[1]);
      for (int j = 0; j <= degree; ++j)
        for (int i = 0; i <= degree; ++i)
          result.history(e, j * (degree + 1) + i) = old.history(parent, v[j] * (degree + 1) + u[i]);
    }
  return result;
}

} // namespace sherd
