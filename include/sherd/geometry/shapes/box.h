#pragma once

#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/shapes/checks.h>

namespace sherd::shapes
{

/// Which faces a box has.
enum class Lid
{
  closed, ///< all six
  open    ///< none at the top
};

/// Box [0, size_x] x [0, size_y] x [0, size_z] of flat faces joined along their folds of 90 degrees, normals outward.
///
/// Patches in the order bottom, top (z = 0, size_z), left, right (x = 0, size_x), front, back (y = 0, size_y); an open
/// box has no top, and its free sides are the edge "rim". The folds have names too, such as "bottom left" or "right
/// back" (faces in the order above), for forces and probes along them.
/// @param elements   along x, y and z
/// @throws InvalidParameter   a size that is not positive, less than one element
template <int degree>
Surface<degree, 3> box(const std::array<double, 3> &size, const std::array<int, 3> &elements, Lid lid = Lid::closed)
{
  for (int d = 0; d < 3; ++d)
    {
      internal::check_length("box: size[" + std::to_string(d) + "]", size[d]);
      if (elements[d] < 1)
        throw InvalidParameter("box: elements[" + std::to_string(d) + "] = " + std::to_string(elements[d]) +
                               ", expected at least 1");
    }
  struct Face
  {
    const char *name;
    int         u, v, normal; // axes
    bool        high;         // at the upper end of the normal axis
  };
  std::vector<Face> faces{{"bottom", 1, 0, 2, false}, {"top", 0, 1, 2, true},    {"left", 2, 1, 0, false},
                          {"right", 1, 2, 0, true},   {"front", 0, 2, 1, false}, {"back", 2, 0, 1, true}};
  if (lid == Lid::open)
    faces.erase(faces.begin() + 1);

  std::vector<Patch<degree, 3>> patches;
  for (const auto &face : faces)
    patches.push_back(interpolate<degree, 3>(uniform_knots<degree>(elements[face.u]),
                                             uniform_knots<degree>(elements[face.v]),
                                             [&](double u, double v) -> Eigen::Vector3d {
                                               Eigen::Vector3d X;
                                               X[face.u]      = u / elements[face.u] * size[face.u];
                                               X[face.v]      = v / elements[face.v] * size[face.v];
                                               X[face.normal] = face.high ? size[face.normal] : 0.;
                                               return X;
                                             })
                          .patch(0));

  // The side of a face that another one covers, and whether its parameter runs along an axis: always, and upwards.
  const auto side_towards = [](const Face &face, const Face &other) {
    if (other.normal == face.u)
      return other.high ? Side::u_max : Side::u_min;
    return other.high ? Side::v_max : Side::v_min;
  };
  std::map<std::string, std::vector<Edge>> edges;
  std::vector<Interface>                   folds;
  for (int a = 0; a < static_cast<int>(faces.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(faces.size()); ++b)
      if (faces[a].normal != faces[b].normal)
        {
          const Edge on_a{a, side_towards(faces[a], faces[b])}, on_b{b, side_towards(faces[b], faces[a])};
          folds.push_back({on_a, on_b, false});
          edges[std::string(faces[a].name) + " " + faces[b].name] = {on_a};
        }
  if (lid == Lid::open)
    for (int p = 1; p < 5; ++p)
      edges["rim"].push_back({p, faces[p].u == 2 ? Side::u_max : Side::v_max});
  return {std::move(patches), std::move(edges), std::move(folds)};
}

} // namespace sherd::shapes
