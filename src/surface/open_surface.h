#pragma once

#include <optional>
#include <string>
#include <vector>

#include "surface/cut_planes.h"
#include "surface/surface_array.h"
#include "surface/triangle_surface.h"

namespace hexwall {

struct OpenOptions {
  bool automatic = true;                 ///< look for caps by known arrays, else by their shape
  std::optional<std::string> cap_array;  ///< cell array that marks the caps
  std::vector<CutPlane> cuts;            ///< ends to be cut off
};

/// An end that was opened.
struct OpenedCap {
  std::string name;  ///< of the cut, or after the array and its value (ModelFaceID_2), or empty
  Vec3 center;
  double radius;  ///< of the circle of equal area
  Vec3 normal;    ///< unit, out of the vessel
  double area;
  std::string how;  ///< "array ModelFaceID = 2", "flat cap", "cut"
};

struct OpenResult {
  TriangleSurface surface;
  std::vector<OpenedCap> caps;     ///< cuts in their order, then caps
  std::vector<int> origin;         ///< #F: triangle of the input that it is, or is a piece of
  std::vector<std::string> notes;  ///< one sentence for each opened end
};

/// What was opened, in a sentence.
std::string describe(const OpenedCap& cap);

/// Opens the ends of a vessel: first the cuts (see `clip`), then the caps: those that
/// `cap_array` marks, or else, if `automatic`, those that an array known to mark caps marks, or
/// else those found by their shape (see `labelled_caps`, `flat_caps`).
/// The surface need not be manifold. A surface without caps comes back as it is.
/// \pre each cell array has #F tuples.
/// \throws UsageError for a `cap_array` that is missing or marks nothing, GeometryError for cuts
/// that cannot be made or if nothing would be left.
OpenResult open_surface(const TriangleSurface& surface,
                        const std::vector<SurfaceArray>& cell_arrays, const OpenOptions& options);

}  // namespace hexwall
