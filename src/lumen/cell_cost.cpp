#include "lumen/cell_cost.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace hexwall::cost {
namespace {

// What checkMesh reports, and the powers by which costs grow towards that.
constexpr double limit_cosine = 0.342;  // of 70 degrees
constexpr double limit_skewness = 4.0;
constexpr double limit_weight = 0.05;
constexpr double limit_volume_ratio = 0.01;
constexpr double limit_determinant = 0.008;  // checkMesh divides by 8, the determinant of a cube
constexpr double least_determinant = 0.0085;

// A quad between cells whose centres are so near its corners' planes can't be split into face tets.
constexpr double limit_split = 0.01;
// A cell is concave where a face's centre is so near another one's plane.
constexpr double limit_depth = 0.01;
// Below this share both grow by `margin_slope` times what is lacking.
constexpr double least_margin = 0.001;
constexpr double margin_slope = 1e6;

double square(double x) {
  return x * x;
}

double tenth_power(double x) {
  return square(square(square(x)) * x);
}

double sixth_power(double x) {
  return square(x * x * x);
}

// Of a margin that has to be positive.
double of_margin(double margin, double limit) {
  return square(limit / std::max(margin, least_margin)) +
         margin_slope * std::max(0.0, least_margin - margin);
}

// Of a quad that has to be split into triangles which both centres see from their own side
// (polyMeshTetDecomposition).
double of_split(std::span<const Vec3> face, const Vec3& owner, const Vec3& other) {
  const VectorLanes quad({face[0], face[1], face[2], face[3]});
  const double height = best_split_height(quad, &owner, &other);
  return of_margin(height / (other - owner).norm(), limit_split);
}

}  // namespace

double of_face(std::span<const Vec3> face, const FaceGeometry& geometry, const CellGeometry& owner,
               const CellGeometry& other) {
  const double below = geometry.area.dot(geometry.center - owner.center);
  const double above = geometry.area.dot(other.center - geometry.center);
  if (below <= 0.0 || above <= 0.0 || owner.volume <= 0.0 || other.volume <= 0.0) return invalid;
  const Vec3 d = other.center - owner.center;
  const double cosine =
      d.dot(geometry.area) / std::sqrt(d.squaredNorm() * geometry.area.squaredNorm());
  const double weight = std::min(below, above) / (below + above);
  const auto [less, more] = std::minmax(owner.volume, other.volume);
  const double split = face.size() == 4 ? of_split(face, owner.center, other.center) : 0.0;
  return split + tenth_power((1.0 - cosine) / (1.0 - limit_cosine)) +
         sixth_power(skewness_between(face, geometry, owner.center, other.center) /
                     limit_skewness) +
         square(square(limit_weight / weight)) + square(limit_volume_ratio * more / less);
}

double of_boundary_face(std::span<const Vec3> face, const FaceGeometry& geometry,
                        const CellGeometry& owner) {
  if (geometry.area.dot(geometry.center - owner.center) <= 0.0) return invalid;
  return sixth_power(skewness_at_boundary(face, geometry, owner.center) / limit_skewness);
}

double of_cell(std::span<const Vec3> areas) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  double sum = 0.0;
  for (const Vec3& area : areas) {
    tensor += area * area.transpose();
    sum += area.norm();
  }
  const double mean = sum / static_cast<double>(areas.size());
  const double share = tensor.determinant() / sixth_power(mean);
  return square(1.5 * limit_determinant / share) +
         margin_slope * std::max(0.0, least_determinant - share);
}

double of_depth(std::span<const FaceGeometry> faces) {
  double least = 1.0;
  for (const FaceGeometry& face : faces) {
    for (const FaceGeometry& other : faces) {
      if (&face == &other) continue;
      const Vec3 d = face.center - other.center;
      const double scale = std::sqrt(d.squaredNorm() * face.area.squaredNorm());
      least = std::min(least, scale > 0.0 ? d.dot(face.area) / scale : 0.0);
    }
  }
  return of_margin(least, limit_depth);
}

}  // namespace hexwall::cost
