#pragma once

#include <vector>

#include "foliation/critical_graph.h"

namespace hexwall {

/// A boundary circle of a cylinder: arcs in the order of rising x.
struct Circle {
  std::vector<int> arcs;
  std::vector<double> start;  ///< coordinate at which each arc starts; the first one at 0
  double length = 0.0;
};

/// One step of a rising path: an edge from its lower to its upper vertex.
struct PathStep {
  int halfedge;
  double x_tail;  ///< x at the lower vertex, in the coordinate of the cylinder
};

/// A maximal region swept by closed level curves: an annulus between two critical components,
/// mapped by (x, y) onto [0, circumference) x [y_bottom, y_top]. x is the coordinate of the bottom
/// circle, continued by the form.
struct Cylinder {
  int bottom = -1;  ///< critical component below
  int top = -1;     ///< critical component above
  double y_bottom = 0.0, y_top = 0.0;
  Circle bottom_circle, top_circle;
  double twist = 0.0;  ///< coordinate on the top circle minus x, for the same vertical trajectory
  std::vector<PathStep> path;  ///< from the bottom circle to the top circle, y rising throughout

  double height() const { return y_top - y_bottom; }
  double circumference() const { return bottom_circle.length; }
};

/// The cylinders into which the critical graph cuts the surface: 2n - 1 in the generic case.
/// Each is found by a path of rising edges from one of its circles to the other, which also tells
/// by how much they are twisted against each other.
/// \throws Error(internal) if the circles do not match in pairs.
std::vector<Cylinder> find_cylinders(const Connectivity& mesh, const HolomorphicForm& form,
                                     const std::vector<int>& ranks, const CriticalGraph& graph);

/// The closed curve of a cylinder at height `y`, strictly between its ends.
LevelCurve level_curve(const Connectivity& mesh, const HolomorphicForm& form,
                       const Cylinder& cylinder, double y);

}  // namespace hexwall
