#pragma once

#include <optional>
#include <vector>

#include <sherd/algebra/vector.h>
#include <sherd/forms/edge_moment.h>
#include <sherd/forms/loads.h>
#include <sherd/forms/pressure.h>

namespace sherd
{

/// Loads of one time, evaluated where the element loop integrates them, and that time, at which weak conditions on
/// edges are asked for. Made by Assembler::evaluate; belongs to its mesh.
template <class Model>
struct LoadValues
{
  struct EdgeMoment
  {
    int                            active; ///< active element
    EdgeGeometry<Model::degree, 3> piece;
    PieceMoment<Model::degree>     moment;
  };

  double                              time = 0.;
  std::optional<Vector>               dead;     ///< force of the dead loads, block n_fields; none: zero
  std::vector<ElementPressure<Model>> pressure; ///< of each active element; empty: none
  std::vector<EdgeMoment>             moments;
};

/// (1 - weight) a + weight b of the loads of two times on the same mesh.
template <class Model>
LoadValues<Model> interpolate(double weight, const LoadValues<Model> &a, const LoadValues<Model> &b)
{
  LoadValues<Model> result = a;
  const auto        mix    = [weight](double &x, double y) { x += weight * (y - x); };
  mix(result.time, b.time);
  if (result.dead)
    for (std::size_t i = 0; i < result.dead->local().size(); ++i)
      mix(result.dead->local()[i], b.dead->local()[i]);
  for (std::size_t e = 0; e < result.pressure.size(); ++e)
    for (std::size_t q = 0; q < result.pressure[e].constant.size(); ++q)
      {
        mix(result.pressure[e].constant[q], b.pressure[e].constant[q]);
        mix(result.pressure[e].by_phase[q], b.pressure[e].by_phase[q]);
      }
  for (std::size_t m = 0; m < result.moments.size(); ++m)
    for (std::size_t q = 0; q < result.moments[m].moment.size(); ++q)
      mix(result.moments[m].moment[q], b.moments[m].moment[q]);
  return result;
}

} // namespace sherd
