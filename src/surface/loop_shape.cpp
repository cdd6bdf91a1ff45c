#include "surface/loop_shape.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace hexwall {

LoopShape loop_shape(const std::vector<Vec3>& loop) {
  const std::size_t n = loop.size();
  LoopShape shape{Vec3::Zero(), Vec3::Zero(), 0.0, 0.0, 0.0};
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : loop) mean += p / static_cast<double>(n);
  Vec3 area_vector = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& p = loop[i];
    const Vec3& q = loop[(i + 1) % n];
    shape.length += (q - p).norm();
    area_vector += 0.5 * (p - mean).cross(q - mean);
  }
  shape.area = area_vector.norm();
  shape.radius = std::sqrt(shape.area / std::numbers::pi);
  shape.center = mean;
  if (shape.area == 0.0) return shape;
  shape.normal = area_vector / shape.area;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = loop[i] - mean;
    const Vec3 q = loop[(i + 1) % n] - mean;
    shape.center += 0.5 * p.cross(q).dot(shape.normal) / shape.area * (p + q) / 3.0;
  }
  return shape;
}

std::vector<Vec3> points_of(const TriangleSurface& surface, const std::vector<int>& loop) {
  std::vector<Vec3> points;
  points.reserve(loop.size());
  for (const int v : loop) points.push_back(surface.points[v]);
  return points;
}

}  // namespace hexwall
