#pragma once

#include <string>
#include <vector>

#include "surface/connectivity.h"
#include "surface/triangle_surface.h"

/// The steps of `repair.h` one by one; for its use only. Each changes `state` only if it finds
/// something to do, and then drops the points that no triangle uses any longer.
namespace hexwall::repair {

struct State {
  TriangleSurface surface;
  std::vector<int> origin;  ///< #F: input triangle, -1 for a new one
};

struct Outcome {
  std::vector<Vec3> places;  ///< one of each fault that was repaired
  std::string text;          ///< what was done, without the places
};

/// Joins boundary edges whose ends are no further apart than `distance`, and splits the triangles
/// whose boundary edge lies along a chain of other boundary edges (T-junctions).
Outcome weld(State& state, double distance);

/// Takes out triangles without area: one with an edge up to `distance` long by merging the ends,
/// others by letting the triangles at their longest edge run through their third vertex.
Outcome remove_degenerate(State& state, double distance);

/// Keeps the first of the triangles with the same three vertices.
Outcome remove_duplicates(State& state);

/// Drops sheets of less than the share `small` of the area that hang on edges with more than two
/// triangles, where it is clear which sheet is the surplus one, and separates parts that touch in
/// vertices or edges.
Outcome make_manifold(State& state, double small);

/// Keeps the component of the largest area. \throws TopologyError if another one has at least the
/// share `small` of the area, or the largest less than half of it.
Outcome keep_largest_component(State& state, double small);

/// Turns triangles as `orient` does; leaves surfaces that cannot be oriented.
Outcome turn_outward(State& state);

/// Fills the holes with a perimeter below `length`, or by default those described in RepairOptions.
/// \param mesh of `state.surface`.
Outcome fill_pinholes(State& state, const Connectivity& mesh, const double* length);

/// Collapses needles, flips caps and draws those at the boundary onto it, each time no point moves
/// further than `tolerance` from the surface that came in. \pre oriented manifold.
Outcome remove_slivers(State& state, double tolerance);

/// Remeshes the surface isotropically if its triangles are hopeless, or in any case if `edge` is
/// given; stays as it is if the result were further away than `tolerance`. \pre oriented manifold.
Outcome remesh_hopeless(State& state, const double* edge, double tolerance);

/// Smooths the neighbourhood of triangles that cross others, moving no vertex by more than
/// `tolerance`; stays as it is if that does not separate them. `is_free` says whether the surface
/// has no self-intersection in the end. \pre oriented manifold, all triangles have area.
Outcome resolve_intersections(State& state, double tolerance, bool& is_free);

}  // namespace hexwall::repair
