#pragma once

#include <filesystem>
#include <string>

#include <sherd/base/environment.h>
#include <sherd/geometry/lower_degree.h>
#include <sherd/geometry/surface.h>

/// Surfaces in the XML files of G+Smo: elements Geometry of type TensorBSpline2 or TensorNurbs2, and a MultiPatch that
/// says which of them are joined along which sides.
///
/// Reading takes the patches of the MultiPatch, in its order, or all geometries if there is none. Interfaces are those
/// that it lists; if it lists neither interfaces nor boundary sides, patches are joined along all sides that coincide
/// (find_interfaces). `<boundary name="...">` gives an edge of this name; sides that are neither joined nor named are
/// the edge "boundary", and a single patch without names has "left", "right", "bottom", "top" besides. A planar file
/// read into space lies in the plane z = 0. Other elements of the file (functions, boundary conditions, options) are
/// ignored.
namespace sherd
{

/// Reads the surface on every rank. Collective.
/// @param lower   what to do with patches of a lower degree than the template argument
/// @throws FileError   "file:line: what was found, what is expected": no such file; malformed XML; another geometry
///                     (curve, volume, hierarchical splines); not the right number of knots, points or weights; knots
///                     that do not ascend or are not open; weights that are not positive; a higher degree than the
///                     template argument, or a lower one unless it is elevated; another dimension; interfaces of sides
///                     that do not exist or do not coincide
template <int degree, int spacedim>
Surface<degree, spacedim> read_gismo_xml(const Environment &env, const std::filesystem::path &file,
                                         LowerDegree lower = LowerDegree::refuse);

/// The same from a text; @p name stands for the file in messages.
template <int degree, int spacedim>
Surface<degree, spacedim> parse_gismo_xml(const std::string &text, const std::string &name = "text",
                                          LowerDegree lower = LowerDegree::refuse);

/// Rank 0 writes patches, interfaces and names of edges (not those of joined sides). Collective.
///
/// Read back, knots, points and weights are the same bit by bit (shortest decimals that do so).
/// @throws FileError          if it cannot be written
/// @throws InvalidParameter   a patch that was refined locally
template <int degree, int spacedim>
void write_gismo_xml(const Environment &env, const std::filesystem::path &file,
                     const Surface<degree, spacedim> &surface);

/// The text that write_gismo_xml writes.
template <int degree, int spacedim>
std::string to_gismo_xml(const Surface<degree, spacedim> &surface);

} // namespace sherd
