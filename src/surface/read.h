#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "surface/surface_array.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct ReadResult {
  TriangleSurface surface;
  std::vector<SurfaceArray> point_arrays;  ///< the file's numbers per point, #V tuples each
  std::vector<SurfaceArray> cell_arrays;   ///< the file's numbers per polygon, #F tuples each
  std::vector<std::string> notes;          ///< what was converted or left out, one sentence each
};

/// Reads a surface in the format that the file's extension names, in upper or lower case:
/// .stl (text or binary), .obj, .ply, .off, .vtp, .vtk.
///
/// Points keep the file's order and unit. STL shares no points between triangles, so that points of
/// exactly equal coordinates are merged; the other formats keep their own sharing, but for boundary
/// points of exactly equal coordinates, which only a slit can have. Quads and larger polygons are
/// split into triangles. Points that no triangle uses are left out. Nothing else is repaired or
/// checked: see `check_surface`.
///
/// Arrays of numbers come along from .vtp, .vtk and .ply (there properties that are no lists, but
/// for coordinates and normals). A triangle has the values of the polygon or strip it comes from, a
/// merged point those of the first of its copies.
/// \throws ReadError, naming the file, if it is missing, a directory, empty, truncated, of an
/// unknown extension, not of its format, without triangles, or refers to points it does not have.
/// Not to be called by several threads at the same time (VTK's message window is global).
ReadResult read_surface(const std::filesystem::path& path);

}  // namespace hexwall
