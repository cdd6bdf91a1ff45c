#include "surface/triangle_surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

namespace hexwall {
namespace {

// A triangle counts as without area below this fraction of its longest edge squared. The cross
// product of two edges carries a rounding error of some 1e-16 of that, so that 1e-14 finds the
// triangles whose normal is noise, while a needle of aspect ratio 1e13 still passes.
constexpr double degenerate_area = 1e-14;

double longest_edge_squared(const TriangleSurface& surface, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  const auto& p = surface.points;
  return std::max(
      {(p[b] - p[a]).squaredNorm(), (p[c] - p[b]).squaredNorm(), (p[a] - p[c]).squaredNorm()});
}

}  // namespace

std::string coordinates(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

Vec3 doubled_area_vector(const TriangleSurface& surface, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  const auto& p = surface.points;
  return (p[b] - p[a]).cross(p[c] - p[a]);
}

Vec3 centroid(const TriangleSurface& surface, int f) {
  const auto& [a, b, c] = surface.triangles[f];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3.0;
}

bool has_area(const TriangleSurface& surface, int f) {
  const double area = 0.5 * doubled_area_vector(surface, f).norm();
  return area > degenerate_area * longest_edge_squared(surface, f);
}

double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = (b - a).norm();
  const double y = (c - b).norm();
  const double z = (a - c).norm();
  const double product = x * y * z * (x + y + z);
  return product > 0.0 ? 4.0 * (b - a).cross(c - a).squaredNorm() / product : 0.0;
}

double mean_edge_length(const TriangleSurface& surface) {
  double sum = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto& p = surface.points;
    sum += (p[b] - p[a]).norm() + (p[c] - p[b]).norm() + (p[a] - p[c]).norm();
  }
  return surface.triangles.empty() ? 0.0
                                   : sum / (3.0 * static_cast<double>(surface.triangles.size()));
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
