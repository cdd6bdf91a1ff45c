#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// A plane that cuts an end off a vessel.
struct CutPlane {
  Vec3 point;                    ///< near the cut, such as on the vessel's axis
  Vec3 normal;                   ///< unit, towards what is removed
  std::optional<double> radius;  ///< the cut must lie within this distance of the point
  std::string name;              ///< of the opening, may be empty
};

/// Reads planes, one per line: `x y z nx ny nz [radius] [name]`, separated by blanks or commas. The
/// normal may have any length; the rest of a line after '#' is a comment.
/// \throws ReadError, naming the file and the line, if it cannot be opened, holds no plane, or a
/// line is not of this form, has the normal 0, a radius that is not positive or an invalid name.
std::vector<CutPlane> read_cut_planes(const std::filesystem::path& path);

}  // namespace hexwall
