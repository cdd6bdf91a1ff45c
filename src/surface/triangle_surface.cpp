#include "surface/triangle_surface.h"

#include <cmath>

#include <Eigen/Geometry>

namespace hexwall {

Vec3 doubled_area_vector(const TriangleSurface& surface, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  const auto& p = surface.points;
  return (p[b] - p[a]).cross(p[c] - p[a]);
}

double total_area(const TriangleSurface& surface) {
  double area = 0.0;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    area += 0.5 * doubled_area_vector(surface, f).norm();
  }
  return area;
}

double bounding_box_diagonal(const TriangleSurface& surface) {
  if (surface.points.empty()) return 0.0;
  Vec3 low = surface.points.front();
  Vec3 high = low;
  for (const Vec3& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

std::vector<Vec3> vertex_normals(const TriangleSurface& surface) {
  std::vector<Vec3> normals(surface.points.size(), Vec3::Zero());
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    const Vec3 normal = doubled_area_vector(surface, f).normalized();
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = surface.points[surface.triangles[f][k]];
      const Vec3 u = surface.points[surface.triangles[f][(k + 1) % 3]] - p;
      const Vec3 v = surface.points[surface.triangles[f][(k + 2) % 3]] - p;
      normals[surface.triangles[f][k]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
    }
  }
  for (Vec3& n : normals) n.normalize();
  return normals;
}

}  // namespace hexwall
