#pragma once

#include <string>
#include <vector>

#include "surface/surface_array.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// What a file holds before it is a triangle surface: polygons of three or more corners.
struct PolygonSoup {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> polygons;  ///< vertex indices, in the file's winding
  std::vector<SurfaceArray> point_arrays, polygon_arrays;
  std::vector<std::string> notes;  ///< what the reader left out, for the user
};

/// Merges points of exactly equal coordinates; the first of each stays, in the order of the file.
/// No tolerance: formats without shared points repeat the same number for the same point.
void weld_equal_points(PolygonSoup& soup);

struct TriangulateResult {
  TriangleSurface surface;
  std::vector<int> point_origin;     ///< #V: its point in the soup
  std::vector<int> triangle_origin;  ///< #F: its polygon in the soup
};

/// Splits quads on their shorter diagonal and larger polygons by ear cutting, drops the points that
/// no triangle uses, and merges boundary vertices of exactly equal coordinates. Adds a note to
/// `soup.notes` for each of these that happened. \throws ReadError if an index lies outside [0,
/// #points), a polygon has fewer than 3 corners, or there is no triangle.
TriangulateResult triangulate(PolygonSoup& soup);

}  // namespace hexwall
