#pragma once

#include <filesystem>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Reads points from a text file: x y z on each line, separated by blanks or commas; what follows a
/// '#' is a comment. \throws ReadError, naming file and line, if it is missing or has other
/// content.
std::vector<Vec3> read_points(const std::filesystem::path& path);

/// A value at a place.
struct PointValue {
  Vec3 at;
  double value;
};

/// The same with a value: x y z value on each line.
std::vector<PointValue> read_point_values(const std::filesystem::path& path);

}  // namespace hexwall
