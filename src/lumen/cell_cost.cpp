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

// A quad between cells whose centres are so near its corners' planes can't be split into face tets.
constexpr double limit_split = 0.01;
// Below this it grows by `split_slope` times what is lacking.
constexpr double least_split = 0.001;
constexpr double split_slope = 1e6;

double square(double x) {
  return x * x;
}

double tenth_power(double x) {
  return square(square(square(x)) * x);
}

double sixth_power(double x) {
  return square(x * x * x);
}

// Of a quad that has to be split into triangles which both centres see from their own side
// (polyMeshTetDecomposition).
double of_split(std::span<const Vec3> face, const Vec3& owner, const Vec3& other) {
  const Face quad{face[0], face[1], face[2], face[3]};
  const double height =
      std::max(split_height(quad, 0, &owner, &other), split_height(quad, 1, &owner, &other));
  const double share = height / (other - owner).norm();
  return square(limit_split / std::max(share, least_split)) +
         split_slope * std::max(0.0, least_split - share);
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
  return square(1.5 * limit_determinant * sixth_power(mean) / tensor.determinant());
}

}  // namespace hexwall::cost
