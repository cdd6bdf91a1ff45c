#pragma once

#include <Eigen/Core>

#include "options.h"

class vtkCamera;
class vtkDataSet;

namespace hexwall {

/// Points as columns.
using Points = Eigen::Matrix3Xd;

Points points_of(vtkDataSet* data);

/// Aims the camera so that the points, or what the options focus on, fill the viewport of aspect
/// ratio width : height.
void aim_camera(vtkCamera* camera, const Points& points, const PictureOptions& options,
                double aspect);

}  // namespace hexwall
