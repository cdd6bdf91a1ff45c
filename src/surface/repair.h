#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// One step of the repair of a surface, in the order in which they run.
enum class RepairStep {
  weld,           ///< joins boundary edges that lie in the same place, and T-junctions
  degenerate,     ///< takes out triangles without area
  duplicate,      ///< keeps one of several triangles with the same three vertices
  nonmanifold,    ///< drops fins and inner walls, separates parts that touch
  components,     ///< keeps the largest component
  orient,         ///< winds all triangles counter-clockwise seen from outside
  pinholes,       ///< fills small holes
  slivers,        ///< collapses needles and flips caps
  remesh,         ///< remeshes where the triangles are hopeless
  intersections,  ///< smooths the surface where it crosses itself
};

/// "weld", "degenerate", ...: as in `RepairStep`.
std::string_view name(RepairStep step);

/// \throws UsageError, listing the names, if `name` is none of them.
RepairStep repair_step_from_name(std::string_view name);

/// All steps, in their order.
std::vector<RepairStep> all_repair_steps();

struct RepairOptions {
  std::vector<RepairStep> steps = all_repair_steps();  ///< those to run; their order here is free

  /// Greatest distance by which slivers, remeshing and intersections may change the shape; default:
  /// half the mean edge length, which is what the surface resolves.
  std::optional<double> tolerance;

  /// Holes with a shorter perimeter are filled. Default: holes of up to 8 mean edge lengths or 2 %
  /// of the longest loop, but never a quarter of it, that lie in the surface rather than across the
  /// end of a tube.
  std::optional<double> pinhole_length;

  /// Components and sheets with less than this share of the area may be dropped.
  double small_component = 0.05;

  /// Edge length to remesh the whole surface with. Default: remeshed only if more than a tenth of
  /// the area is in triangles of quality below 0.1; then with the edge of as many equilateral
  /// triangles, or the mean boundary edge where that is shorter, but not if that would cut them or
  /// their sides into more than 30 pieces in the mean, unless 20,000 triangles are enough, nor if
  /// it would cut a side into more than 100.
  std::optional<double> remesh_edge;
};

/// What one step did.
struct RepairAction {
  RepairStep step;
  int count = 0;     ///< of the faults that were repaired
  std::string text;  ///< one sentence for the user, with the first few places
  std::vector<Vec3> places;
};

struct RepairResult {
  TriangleSurface surface;
  std::vector<int> origin;            ///< #F: input triangle of each triangle, -1 for a new one
  std::vector<RepairAction> actions;  ///< of the steps that had something to do

  /// Greatest distance between the surface with its pinholes filled and the result, both ways,
  /// measured at the corners and centroids of all triangles that changed.
  double moved = 0.0;

  /// The result was found free of self-intersections: `check_surface` needs no second test.
  bool is_free_of_intersections = false;
};

/// The steps from `weld` to `orient`: they select, renumber and split triangles between existing
/// points, so that each triangle of the result has an origin. A surface without faults comes out
/// bit for bit as it is, and so does one with coordinates that are not finite. What cannot be
/// repaired without guessing is left for `check_surface` to refuse. \pre each index lies in [0,
/// #V). \throws TopologyError if a component other than the largest is not small, or the largest
/// has less than half of the area; UsageError for options out of range. Cost: O(#F log #F).
RepairResult repair_topology(const TriangleSurface& surface, const RepairOptions& options = {});

/// The steps from `pinholes` to `intersections`, which change the shape by no more than the
/// tolerance. Boundary loops stay on their polylines. A surface without faults comes out bit for
/// bit as it is, and so does one that is not an oriented manifold of finite coordinates. What
/// cannot be repaired within the tolerance is left for `check_surface` to refuse. \pre each index
/// lies in [0, #V). \throws UsageError for options out of range, or if remeshing with the edge
/// asked for would move the surface by more than the tolerance.
RepairResult repair_geometry(const TriangleSurface& surface, const RepairOptions& options = {});

}  // namespace hexwall
