#include "camera.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <vtkCamera.h>
#include <vtkDataSet.h>

#include "exporters/view_frame.h"

namespace hexwall {
namespace {

/// Columns: right, up, towards the eye.
Eigen::Matrix3d frame_looking_from(Eigen::Vector3d eye) {
  eye.normalize();
  const Eigen::Vector3d up =
      std::abs(eye.z()) > 0.99 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d frame;
  frame.col(2) = eye;
  frame.col(0) = up.cross(eye).normalized();
  frame.col(1) = eye.cross(frame.col(0));
  return frame;
}

Eigen::Matrix3d frame_for(const PictureOptions& options, const Points& points) {
  if (!options.frame.empty()) {
    Eigen::Matrix3d frame;
    frame.col(0) = Eigen::Vector3d::Map(options.frame.data()).normalized();
    frame.col(2) = frame.col(0).cross(Eigen::Vector3d::Map(options.frame.data() + 3)).normalized();
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
  }
  return options.view.empty() ? frame_of_points(points)
                              : frame_looking_from(Eigen::Vector3d::Map(options.view.data()));
}

}  // namespace

Points points_of(vtkDataSet* data) {
  Points points(3, data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) data->GetPoint(i, points.col(i).data());
  return points;
}

void aim_camera(vtkCamera* camera, const Points& points, const PictureOptions& options,
                double aspect) {
  const Eigen::Matrix3d frame = frame_for(options, points);
  const Points seen = frame.transpose() * points;
  Eigen::Vector3d low = seen.rowwise().minCoeff();
  Eigen::Vector3d high = seen.rowwise().maxCoeff();
  if (!options.focus.empty()) {
    const Eigen::Vector3d center = frame.transpose() * Eigen::Vector3d::Map(options.focus.data());
    const Eigen::Vector3d radius = Eigen::Vector3d::Constant(options.focus[3]);
    low = low.cwiseMax(center - radius);
    high = high.cwiseMin(center + radius);
  }
  const Eigen::Vector3d size = high - low;
  const double half_height = 0.53 * std::max(size.y(), size.x() / aspect) / options.zoom;
  const Eigen::Vector3d target = frame * (low + high) / 2;
  const double half_angle = camera->GetViewAngle() * EIGEN_PI / 360;
  const double distance = half_height / std::tan(half_angle) + size.z() / 2;
  const Eigen::Vector3d eye = target + distance * frame.col(2);
  camera->SetFocalPoint(target.data());
  camera->SetPosition(eye.data());
  camera->SetViewUp(frame(0, 1), frame(1, 1), frame(2, 1));
  camera->SetParallelScale(half_height);
  camera->SetParallelProjection(!options.perspective);
}

}  // namespace hexwall
