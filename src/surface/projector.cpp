#include "surface/projector.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

// Of the weights' sum.
constexpr double inside_margin = 1e-9;

Vec3 nearest_point_of_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 direction = b - a;
  const double squared = direction.squaredNorm();
  if (squared == 0.0) return a;
  return a + std::clamp((p - a).dot(direction) / squared, 0.0, 1.0) * direction;
}

/// The point of a triangle that is nearest to another one.
struct FootPoint {
  Vec3 position;
  bool is_inside;  ///< clear of the edges, where a neighbour may be nearer
};

FootPoint foot_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double wa = (c - b).cross(p - b).dot(normal);
  const double wb = (a - c).cross(p - c).dot(normal);
  const double wc = (b - a).cross(p - a).dot(normal);
  const double sum = wa + wb + wc;
  const double least = std::min({wa, wb, wc});
  if (least >= 0.0 && sum > 0.0) {
    return {(wa * a + wb * b + wc * c) / sum, least > inside_margin * sum};
  }
  Vec3 best = nearest_point_of_segment(p, a, b);
  for (const Vec3& q : {nearest_point_of_segment(p, b, c), nearest_point_of_segment(p, c, a)}) {
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return {best, false};
}

}  // namespace

Vec3 nearest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  return foot_on_triangle(p, a, b, c).position;
}

Vec3 barycentric_coordinates(const TriangleSurface& surface, const SurfacePoint& point) {
  const auto& [a, b, c] = surface.triangles[point.face];
  const Vec3 u = surface.points[b] - surface.points[a];
  const Vec3 v = surface.points[c] - surface.points[a];
  const Vec3 w = point.position - surface.points[a];
  const Vec3 normal = u.cross(v);
  const double squared = normal.squaredNorm();
  const double wb = w.cross(v).dot(normal) / squared;
  const double wc = u.cross(w).dot(normal) / squared;
  return {1.0 - wb - wc, wb, wc};
}

std::vector<double> interpolated_values(const TriangleSurface& surface,
                                        const std::vector<double>& values,
                                        const std::vector<SurfacePoint>& points) {
  std::vector<double> result;
  result.reserve(points.size());
  for (const SurfacePoint& point : points) {
    const Vec3 w = barycentric_coordinates(surface, point);
    const auto& [a, b, c] = surface.triangles[point.face];
    result.push_back(w[0] * values[a] + w[1] * values[b] + w[2] * values[c]);
  }
  return result;
}

std::vector<Vec3> interpolated_normals(const TriangleSurface& surface,
                                       const std::vector<SurfacePoint>& points) {
  const std::vector<Vec3> normals = vertex_normals(surface);
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const SurfacePoint& point : points) {
    const Vec3 w = barycentric_coordinates(surface, point);
    const auto& [a, b, c] = surface.triangles[point.face];
    result.push_back((w[0] * normals[a] + w[1] * normals[b] + w[2] * normals[c]).normalized());
  }
  return result;
}

SurfaceProjector::SurfaceProjector(const TriangleSurface& surface, const Connectivity& mesh)
    : surface_(surface), first_(mesh.vertex_count() + 1, 0), faces_(mesh.halfedge_count()) {
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) ++first_[v + 1];
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) first_[v + 1] += first_[v];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int f = 0; f < mesh.face_count(); ++f) {
    for (const int v : surface.triangles[f]) faces_[next[v]++] = f;
  }
}

SurfacePoint SurfaceProjector::project(const Vec3& p, int start_face) const {
  const auto foot = [&](int f) {
    const auto& [a, b, c] = surface_.triangles[f];
    return foot_on_triangle(p, surface_.points[a], surface_.points[b], surface_.points[c]);
  };
  int face = start_face;
  FootPoint best = foot(face);
  // A foot point inside a triangle is a local minimum of the distance already.
  for (int center = -1; !best.is_inside && face != center;) {
    center = face;
    for (const int v : surface_.triangles[center]) {
      for (int i = first_[v]; i < first_[v + 1]; ++i) {
        const FootPoint other = foot(faces_[i]);
        if ((other.position - p).squaredNorm() >= (best.position - p).squaredNorm()) continue;
        best = other;
        face = faces_[i];
      }
    }
  }
  return {face, best.position};
}

LoopCurve::LoopCurve(std::vector<Vec3> points) : points_(std::move(points)) {}

Vec3 LoopCurve::on_segment(const Vec3& p, int segment) const {
  return nearest_point_of_segment(p, points_[segment], points_[(segment + 1) % points_.size()]);
}

Vec3 LoopCurve::project(const Vec3& p, int& segment) const {
  const int size = segment_count();
  Vec3 best = on_segment(p, segment);
  for (int center = -1; center != segment;) {
    center = segment;
    for (const int s : {(center + 1) % size, (center + size - 1) % size}) {
      const Vec3 q = on_segment(p, s);
      if ((q - p).squaredNorm() < (best - p).squaredNorm()) {
        best = q;
        segment = s;
      }
    }
  }
  return best;
}

double LoopCurve::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    sum += (points_[(i + 1) % points_.size()] - points_[i]).norm();
  }
  return sum;
}

}  // namespace hexwall
