#pragma once

#include <vector>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A point on a surface: its triangle and its position.
struct SurfacePoint {
  int face = -1;
  Vec3 position = Vec3::Zero();
};

/// Weights of the three corners of its triangle; they sum to 1.
Vec3 barycentric_coordinates(const TriangleSurface& surface, const SurfacePoint& point);

/// Unit normals at points of the surface: the vertex normals, interpolated linearly.
std::vector<Vec3> interpolated_normals(const TriangleSurface& surface,
                                       const std::vector<SurfacePoint>& points);

/// Values at points of the surface, interpolated linearly. \param values #V.
std::vector<double> interpolated_values(const TriangleSurface& surface,
                                        const std::vector<double>& values,
                                        const std::vector<SurfacePoint>& points);

/// Nearest points on a surface, found by walking from triangle to neighbouring triangle. It stays
/// on the sheet where it starts, however close another branch passes by.
class SurfaceProjector {
 public:
  /// Keeps references: both must outlive the projector.
  SurfaceProjector(const TriangleSurface& surface, const Connectivity& mesh);

  /// The point of the surface that is nearest to `p` among those that a descent from triangle
  /// `start_face` reaches.
  SurfacePoint project(const Vec3& p, int start_face) const;
  const TriangleSurface& surface() const { return surface_; }

 private:
  const TriangleSurface& surface_;
  std::vector<int> first_;  // #V + 1: triangles of vertex v are faces_[first_[v]..first_[v + 1]]
  std::vector<int> faces_;
};

/// Nearest point of a triangle with corners a, b, c.
Vec3 nearest_point_of_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A closed polyline in space, along which vertices of a boundary loop may slide.
class LoopCurve {
 public:
  explicit LoopCurve(std::vector<Vec3> points);

  /// Nearest point to `p` within a descent from segment `segment`, which is updated.
  Vec3 project(const Vec3& p, int& segment) const;
  int segment_count() const { return static_cast<int>(points_.size()); }
  double length() const;

 private:
  Vec3 on_segment(const Vec3& p, int segment) const;
  std::vector<Vec3> points_;
};

}  // namespace hexwall
