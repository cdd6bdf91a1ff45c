#pragma once

#include <vector>

#include "holomorphic/form.h"
#include "surface/connectivity.h"
#include "surface/projector.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// A point on an edge: (1 - t) tail + t tip of the half-edge.
struct EdgePoint {
  int halfedge = -1;
  double t = 0.0;
};

/// A piece of a level set y = const: a polyline with one segment per triangle, running towards +x.
struct LevelCurve {
  std::vector<EdgePoint> points;
  std::vector<int> faces;  ///< one per segment
  std::vector<double> x;   ///< one per point, never falling
  bool corrected = false;  ///< x of the form was not monotone here and was made so

  double start() const { return x.front(); }
  double length() const { return x.back() - x.front(); }
};

/// Makes the coordinate of an open curve monotone: the mean of its upper and its lower monotone
/// envelope, within the values of its ends. Returns whether anything changed.
bool make_monotone(std::vector<double>& x);

/// The same for a closed curve, whose last value is its first plus the period.
bool make_monotone_periodic(std::vector<double>& x);

/// The closed level curve y = `level` through half-edge `start`, whose tail lies below the level
/// and whose tip does not. x starts at `x_start` there and ends one period later.
LevelCurve trace_closed_level(const Connectivity& mesh, const HolomorphicForm& form, int start,
                              double level, double x_start);

/// A level curve traced between vertices of equal rank.
struct TracedArc {
  LevelCurve curve;
  int arrival = -1;  ///< half-edge from the end vertex to the upper neighbour beside the curve
};

/// The level curve that leaves the tail of `spoke` between the tip of `spoke` (below) and the next
/// neighbour counter-clockwise (above), up to the next vertex of the same rank.
TracedArc trace_arc(const Connectivity& mesh, const HolomorphicForm& form,
                    const std::vector<int>& ranks, int spoke);

/// The point of a curve at coordinate `x` (taken within the curve's ends).
SurfacePoint point_at(const TriangleSurface& surface, const Connectivity& mesh,
                      const LevelCurve& curve, double x);

/// Position of an edge point.
Vec3 position(const TriangleSurface& surface, const Connectivity& mesh, const EdgePoint& point);

}  // namespace hexwall
