#pragma once

#include <Eigen/Core>

namespace hexwall {

/// How to look at points: the columns are right, up and towards the eye. The longest extent of the
/// points lies to the right, the shortest towards the eye, slightly turned so that depth can be
/// seen. \param points 3 x #P.
Eigen::Matrix3d frame_of_points(const Eigen::Matrix3Xd& points);

}  // namespace hexwall
