#pragma once

#include <array>
#include <limits>

#include <Eigen/Core>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Numbers at the four corners of a face, computed with all at once.
using Lanes = Eigen::Array4d;

/// The numbers of the next corners around the face.
inline Lanes next(const Lanes& a) {
  return {a[1], a[2], a[3], a[0]};
}

/// The numbers of the corners before.
inline Lanes previous(const Lanes& a) {
  return {a[3], a[0], a[1], a[2]};
}

/// Points or vectors at the four corners of a face.
struct VectorLanes {
  Lanes x, y, z;

  VectorLanes(const Lanes& x_lanes, const Lanes& y_lanes, const Lanes& z_lanes)
      : x(x_lanes), y(y_lanes), z(z_lanes) {}
  explicit VectorLanes(const std::array<Vec3, 4>& v)
      : x(v[0].x(), v[1].x(), v[2].x(), v[3].x()),
        y(v[0].y(), v[1].y(), v[2].y(), v[3].y()),
        z(v[0].z(), v[1].z(), v[2].z(), v[3].z()) {}
  /// The same at all of them.
  explicit VectorLanes(const Vec3& v)
      : x(Lanes::Constant(v.x())), y(Lanes::Constant(v.y())), z(Lanes::Constant(v.z())) {}

  Vec3 mean() const { return {0.25 * x.sum(), 0.25 * y.sum(), 0.25 * z.sum()}; }
  Vec3 operator[](int k) const { return {x[k], y[k], z[k]}; }
};

inline VectorLanes operator+(const VectorLanes& a, const VectorLanes& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline VectorLanes operator-(const VectorLanes& a, const VectorLanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline VectorLanes operator*(const Lanes& s, const VectorLanes& a) {
  return {s * a.x, s * a.y, s * a.z};
}

inline VectorLanes next(const VectorLanes& a) {
  return {next(a.x), next(a.y), next(a.z)};
}

inline VectorLanes previous(const VectorLanes& a) {
  return {previous(a.x), previous(a.y), previous(a.z)};
}

inline Lanes dot(const VectorLanes& a, const VectorLanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline VectorLanes cross(const VectorLanes& a, const VectorLanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Of length 1; a vector of no length stays as it is.
inline VectorLanes normalized(const VectorLanes& a) {
  return dot(a, a).max(std::numeric_limits<double>::min()).sqrt().inverse() * a;
}

}  // namespace hexwall
