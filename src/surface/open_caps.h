#pragma once

#include <optional>
#include <string>
#include <vector>

#include "surface/surface_array.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A lid on the end of a vessel.
struct Cap {
  std::string name;            ///< after the array and its value (ModelFaceID_2), or empty
  std::string how;             ///< by what it was found, for the user
  std::vector<int> triangles;  ///< of the surface, sorted
  std::vector<int> rim;        ///< vertex cycle
  Vec3 outward;                ///< unit normal, away from the vessel
};

/// Caps that an array of the file marks: connected regions of equal value that are disks, and
/// - CapID (SimVascular): have a value above 0;
/// - ModelFaceID (SimVascular) and CellEntityIds (VMTK), which number the wall too: are flat and
///   touch no other such region;
/// - `cap_array`, an array that the user names: are not the region of largest area.
/// Without `cap_array` the first of CapID, ModelFaceID, CellEntityIds that marks any cap counts.
/// A cap is named ARRAY_VALUE, further regions of the same value ARRAY_VALUE_part2 and so on.
/// The surface need not be manifold. \throws UsageError if there is no array `cap_array` of one
/// component or it marks no cap.
std::vector<Cap> labelled_caps(const TriangleSurface& surface,
                               const std::vector<SurfaceArray>& cell_arrays,
                               const std::optional<std::string>& cap_array);

/// Caps by their shape: disks of nearly coplanar triangles, flat, round, and folded sharply against
/// the wall along most of their rim. A flat spot of a vessel or a dome has no such rim. The surface
/// need not be manifold. Cost: O(#F log #F) for caps that are small parts of the surface.
std::vector<Cap> flat_caps(const TriangleSurface& surface);

}  // namespace hexwall
