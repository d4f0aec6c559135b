#pragma once

#include <filesystem>
#include <string>

#include <sherd/base/environment.h>
#include <sherd/geometry/lower_degree.h>
#include <sherd/geometry/surface.h>

/// Surfaces in GoTools files (.g2): spline surfaces one after the other, each with a header "200 1 0 0" (type, version,
/// no further data), "dimension rational", "n order" and the knots of u and of v, and its control points, index along u
/// first; rational ones as (w X, w).
///
/// The format has neither interfaces nor names. On reading, patches are joined along all sides that coincide
/// (find_interfaces), the sides that stay free are the edge "boundary", and those of a single patch have the names
/// "left", "right", "bottom", "top" besides. A planar file read into space lies in the plane z = 0.
namespace sherd
{

/// Reads the surface on every rank. Collective.
/// @param lower   what to do with patches of a lower degree than the template argument
/// @throws FileError   "file:line: what was found, what is expected": no such file; another object than a spline
///                     surface (curves, volumes, trimmed surfaces); a truncated file; not the right number of knots or
///                     points; knots that do not ascend or are not open; weights that are not positive; a higher
///                     degree than the template argument, or a lower one unless it is elevated; another dimension
template <int degree, int spacedim>
Surface<degree, spacedim> read_g2(const Environment &env, const std::filesystem::path &file,
                                  LowerDegree lower = LowerDegree::refuse);

/// The same from a text; @p name stands for the file in messages.
template <int degree, int spacedim>
Surface<degree, spacedim> parse_g2(const std::string &text, const std::string &name = "text",
                                   LowerDegree lower = LowerDegree::refuse);

/// Rank 0 writes the patches of the surface; names of edges are not kept. Collective.
///
/// Read back, knots, points and weights are the same bit by bit: shortest decimals, and products w X with the digits of
/// a long double.
/// @throws FileError          if it cannot be written
/// @throws InvalidParameter   a patch that was refined locally
template <int degree, int spacedim>
void write_g2(const Environment &env, const std::filesystem::path &file, const Surface<degree, spacedim> &surface);

/// The text that write_g2 writes.
template <int degree, int spacedim>
std::string to_g2(const Surface<degree, spacedim> &surface);

} // namespace sherd
