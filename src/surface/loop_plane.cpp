#include "surface/loop_plane.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/tolerances.h"

namespace hexwall {

bool LoopPlane::is_planar() const {
  return deviation <= tolerance::loop_planarity * radius;
}

LoopPlane fit_plane(const std::vector<Vec3>& loop) {
  LoopPlane plane;
  plane.center = Vec3::Zero();
  for (const Vec3& p : loop) plane.center += p / static_cast<double>(loop.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& p : loop) {
    const Vec3 d = p - plane.center;
    covariance += d * d.transpose();
    plane.radius += d.norm() / static_cast<double>(loop.size());
  }
  plane.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
  for (const Vec3& p : loop) {
    plane.deviation = std::max(plane.deviation, std::abs((p - plane.center).dot(plane.normal)));
  }
  return plane;
}

}  // namespace hexwall
