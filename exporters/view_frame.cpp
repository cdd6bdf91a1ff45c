#include "exporters/view_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace hexwall {

Eigen::Matrix3d frame_of_points(const Eigen::Matrix3Xd& points) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred * centred.transpose());
  Eigen::Matrix3d frame = axes.eigenvectors().rowwise().reverse();
  for (int c = 0; c < 2; ++c) {
    Eigen::Index largest = 0;
    frame.col(c).cwiseAbs().maxCoeff(&largest);
    if (frame(largest, c) < 0) frame.col(c) *= -1;
  }
  frame.col(2) = frame.col(0).cross(frame.col(1));
  const Eigen::AngleAxisd sideways(0.35, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd down(-0.25, Eigen::Vector3d::UnitX());
  return frame * (sideways * down).toRotationMatrix();
}

}  // namespace hexwall
