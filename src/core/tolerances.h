#pragma once

/// Every tolerance of the program, each with its reason.
namespace hexwall::tolerance {

/// An edge is flipped or split when the sum of its two opposite cotangents is below minus this:
/// cocircular neighbours (regular grids) give +-1e-15 and must not be touched.
inline constexpr double delaunay_cotangent = 1e-8;

/// A split point keeps this fraction of the edge away from both ends, so that a split never makes
/// an edge much shorter than the geometry asks for.
inline constexpr double delaunay_split_margin = 0.1;

/// Newton stops when the predicted decrease of the normalised energy falls below this: 1e-13 is
/// what a double holds of an energy of order one.
inline constexpr double energy_decrease = 1e-13;

/// A loop counts as planar when its vertices lie this close (relative to its mean radius) to its
/// plane: an STL of single-precision coordinates far from the origin reaches 1e-4.
inline constexpr double loop_planarity = 1e-3;

}  // namespace hexwall::tolerance
