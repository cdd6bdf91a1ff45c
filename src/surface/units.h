#pragma once

#include <optional>
#include <string>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A sentence for the user if the surface, read in the stated unit, has the size of no vessel, with
/// the units in which it would have: a bounding box of 1 mm to 2 m along its diagonal and a mean
/// radius of 0.1 mm to 50 mm. The mean radius is 2 volume / area, that of a tube.
/// \pre as after `check_surface`. \param mesh of `surface`.
std::optional<std::string> unit_warning(const TriangleSurface& surface, const Connectivity& mesh,
                                        double metres_per_unit);

}  // namespace hexwall
