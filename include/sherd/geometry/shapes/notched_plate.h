#pragma once

#include <algorithm>
#include <cmath>

#include <sherd/geometry/shapes/plate.h>

namespace sherd::shapes
{

/// Flat rectangle [0, size_x] x [0, size_y] (z = 0) with a slit from its left edge at (0, tip_y) to (tip_x, tip_y): the
/// single-edge-notched plate. The faces of the slit lie on each other and are free of each other, so that every field
/// may jump there; their meshes need not match once they are refined.
///
/// Four patches meet at the tip: lower left, lower right, upper left, upper right, each with equal elements whose
/// parameters have unit spans and run along x and y. All are joined but the two left ones. Edges "left", "right",
/// "bottom", "top", and the faces of the slit "lower_face", "upper_face".
///
/// Of elements[0] along x the share tip_x / size_x, rounded, is left of the tip, and likewise below it, but at least
/// one on either side: all elements have one size if the tip divides them so.
///
/// Fields are continuous across the interfaces and their slopes are not. A membrane with a second-order crack density
/// needs no more: continuity::None there; in space, and for the fourth-order density, continuity is kept as between all
/// patches (theory G). Slits in general: a Surface joins the sides that its interfaces name, coincident or not.
/// @throws InvalidParameter   a size that is not positive and finite, a tip that is not inside, less than two elements
template <int degree, int spacedim>
Surface<degree, spacedim> notched_plate(const std::array<double, 2> &size, const std::array<double, 2> &tip,
                                        const std::array<int, 2> &elements)
{
  std::array<std::array<double, 2>, 2> lengths;
  std::array<std::array<int, 2>, 2>    counts;
  for (int d = 0; d < 2; ++d)
    {
      const auto place = "[" + std::to_string(d) + "]";
      internal::check_length("notched_plate: size" + place, size[d]);
      if (!(tip[d] > 0. && tip[d] < size[d]))
        throw InvalidParameter("notched_plate: tip" + place + " = " + print(tip[d]) + ", expected a place inside (0, " +
                               print(size[d]) + ")");
      if (elements[d] < 2)
        throw InvalidParameter("notched_plate: elements" + place + " = " + std::to_string(elements[d]) +
                               ", expected at least 2, one on either side of the tip");
      const int before = std::clamp(static_cast<int>(std::lround(elements[d] * tip[d] / size[d])), 1, elements[d] - 1);
      counts[d]        = {before, elements[d] - before};
      lengths[d]       = {tip[d], size[d] - tip[d]};
    }
  std::vector<Patch<degree, spacedim>> patches;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      {
        patches.push_back(
            plate<degree, spacedim>({lengths[0][i], lengths[1][j]}, {counts[0][i], counts[1][j]}).patch(0));
        auto &points = patches.back().control_points;
        points.col(0).array() += i * tip[0];
        points.col(1).array() += j * tip[1];
      }
  constexpr int lower_left = 0, lower_right = 1, upper_left = 2, upper_right = 3;
  return {std::move(patches),
          {{"left", {{lower_left, Side::u_min}, {upper_left, Side::u_min}}},
           {"right", {{lower_right, Side::u_max}, {upper_right, Side::u_max}}},
           {"bottom", {{lower_left, Side::v_min}, {lower_right, Side::v_min}}},
           {"top", {{upper_left, Side::v_max}, {upper_right, Side::v_max}}},
           {"lower_face", {{lower_left, Side::v_max}}},
           {"upper_face", {{upper_left, Side::v_min}}}},
          {{{lower_left, Side::u_max}, {lower_right, Side::u_min}, false},
           {{upper_left, Side::u_max}, {upper_right, Side::u_min}, false},
           {{lower_right, Side::v_max}, {upper_right, Side::v_min}, false}}};
}

} // namespace sherd::shapes
