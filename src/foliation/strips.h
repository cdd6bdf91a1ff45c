#pragma once

#include <vector>

#include "foliation/cylinders.h"

namespace hexwall {

/// A vertical critical trajectory: x = const, from a zero up or down to a boundary loop.
struct VerticalLine {
  int sector = -1;  ///< sector through which it leaves its zero; -1 for the line that cuts a plain
                    ///< annulus open
  bool rising = false;
};

/// Where a vertical line crosses an arc.
struct LineOnArc {
  int line;
  double offset;  ///< x along the arc
};

/// A vertical line in a cylinder, and the strip on its side of greater x.
struct LineInCylinder {
  int line;
  double x_bottom;  ///< x on the bottom circle, in the cylinder's coordinate
  double x_top;     ///< x on the top circle: equal to x_bottom but for rounding and corrections
  int strip;
  int top_arc, top_interval;  ///< arc of the top circle on which the strip ends, and where on it
};

/// Vertical strips, each from boundary loop to boundary loop. Strips times cylinders are the
/// paper's rectangular patches.
struct Strips {
  std::vector<VerticalLine> lines;
  std::vector<std::vector<LineOnArc>> arc_lines;         ///< per arc, by rising offset
  std::vector<std::vector<int>> arc_strips;              ///< per arc: the strips that cross it
  std::vector<std::vector<LineInCylinder>> in_cylinder;  ///< per cylinder, by rising x
  std::vector<double> width;                             ///< per strip, in x

  int count() const { return static_cast<int>(width.size()); }
};

/// Follows the vertical critical trajectories through the cylinders and joins what lies between
/// them to strips: n - 1 plus the number of distinct zeros, half-zeros included.
///
/// Falling lines are placed on the arcs below by comparing x with the arcs' ends; rising lines are
/// then placed by their order among the falling ones alone. The result is therefore consistent
/// whatever the rounding of x.
Strips find_strips(const CriticalGraph& graph, const std::vector<Cylinder>& cylinders);

}  // namespace hexwall
