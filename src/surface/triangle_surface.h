#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace hexwall {

using Vec3 = Eigen::Vector3d;

/// An indexed triangle surface. Vertices are counter-clockwise seen from outside the vessel.
struct TriangleSurface {
  std::vector<Vec3> points;                   ///< #V positions, in the input's length unit
  std::vector<std::array<int, 3>> triangles;  ///< #F vertex triples
};

/// "(x, y, z)" with six digits, for messages.
std::string coordinates(const Vec3& p);

/// Sum of the triangle areas.
double total_area(const TriangleSurface& surface);

/// Length of the diagonal of the axis-aligned bounding box.
double bounding_box_diagonal(const TriangleSurface& surface);

/// Twice the area vector of triangle `f`: its direction is the outward normal.
Vec3 doubled_area_vector(const TriangleSurface& surface, int f);

/// Mean of the corners of triangle `f`.
Vec3 centroid(const TriangleSurface& surface, int f);

/// False if the normal of triangle `f` would be rounding error: its area is below 1e-14 of its
/// longest edge squared, or it uses a vertex twice.
bool has_area(const TriangleSurface& surface, int f);

/// Twice the ratio of the inscribed to the circumscribed circle's radius: 1 for an equilateral
/// triangle, 0 for one without area.
double quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// Mean length of the triangles' sides.
double mean_edge_length(const TriangleSurface& surface);

/// Unit vertex normals, each the angle-weighted mean of its triangles' normals. #V.
std::vector<Vec3> vertex_normals(const TriangleSurface& surface);

}  // namespace hexwall
