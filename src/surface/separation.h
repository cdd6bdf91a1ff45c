#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Tells of faces that a plane between them keeps apart, in constant time: most of those that are
/// near each other.
class Separation {
 public:
  explicit Separation(const std::vector<Vec3>& points);
  explicit Separation(std::vector<Vec3>&&) = delete;  // they are not copied

  /// Whether two triangles or quads certainly meet nowhere but in common vertices or on the line
  /// between two of them, whichever way a quad is split into two triangles. False says nothing.
  /// \param a, b numbers of the corners in order.
  bool is_certain(std::span<const int> a, std::span<const int> b) const;

 private:
  const std::vector<Vec3>& points_;
  double gap_;  // what rounding leaves in doubt
};

/// The pairs of numbers of boxes that meet and are wanted, the lower one first, in rising order.
/// \param is_wanted is asked of each pair that meets, the lower number first, once, in parallel.
/// \param is_active #boxes Only pairs with one of these at least; all if it is empty.
std::vector<std::pair<int, int>> box_pairs(const std::vector<Eigen::AlignedBox3d>& boxes,
                                           const std::function<bool(int, int)>& is_wanted,
                                           const std::vector<char>& is_active = {});

}  // namespace hexwall
