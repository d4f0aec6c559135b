#pragma once

#include <sherd/base/environment.h>
#include <sherd/driver/surface_parameters.h>
#include <sherd/geometry/surface.h>

namespace sherd
{

/// The reference surface that a case file describes, cut into patches, before any refinement. Collective, because it
/// may read a file.
/// @throws InvalidParameter   from the shape; a shape of space in the plane
/// @throws FileError          from the geometry file
template <int degree, int spacedim>
Surface<degree, spacedim> make_surface(const Environment &env, const SurfaceParameters &parameters);

extern template Surface<2, 2> make_surface(const Environment &, const SurfaceParameters &);
extern template Surface<3, 2> make_surface(const Environment &, const SurfaceParameters &);
extern template Surface<4, 2> make_surface(const Environment &, const SurfaceParameters &);
extern template Surface<2, 3> make_surface(const Environment &, const SurfaceParameters &);
extern template Surface<3, 3> make_surface(const Environment &, const SurfaceParameters &);
extern template Surface<4, 3> make_surface(const Environment &, const SurfaceParameters &);

} // namespace sherd
