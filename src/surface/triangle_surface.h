#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace hexwall {

using Vec3 = Eigen::Vector3d;

/// An indexed triangle surface. Vertices are counter-clockwise seen from outside the vessel.
struct TriangleSurface {
  std::vector<Vec3> points;                   ///< #V positions, in the input's length unit
  std::vector<std::array<int, 3>> triangles;  ///< #F vertex triples
};

/// Sum of the triangle areas.
double total_area(const TriangleSurface& surface);

/// Length of the diagonal of the axis-aligned bounding box.
double bounding_box_diagonal(const TriangleSurface& surface);

/// Twice the area vector of triangle `f`: its direction is the outward normal.
Vec3 doubled_area_vector(const TriangleSurface& surface, int f);

/// Unit vertex normals, each the angle-weighted mean of its triangles' normals. #V.
std::vector<Vec3> vertex_normals(const TriangleSurface& surface);

}  // namespace hexwall
