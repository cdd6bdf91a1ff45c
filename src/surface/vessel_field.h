#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "surface/vessel_tree.h"

namespace hexwall {

/// Where a vessel is cut flat.
struct OpenEnd {
  Vec3 center;
  Vec3 direction;  ///< unit, out of the vessel
  double radius;
};

/// Implicit function of a vessel tree: negative inside, zero on the wall, of Lipschitz constant 1.
/// Open ends continue straight beyond their planes.
class VesselField {
 public:
  explicit VesselField(const std::vector<Branch>& branches);

  struct Sample {
    double value;
    Vec3 gradient;
  };
  Sample operator()(const Vec3& x) const;

  /// The point of the zero set reached from `x` by Newton steps along the gradient, to `tolerance`.
  Vec3 project(const Vec3& x, double tolerance) const;
  /// The same within the plane of an open end, on which the result lies.
  Vec3 project_in_plane(const Vec3& x, const OpenEnd& end) const;

  const std::vector<OpenEnd>& ends() const { return ends_; }
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  double smallest_radius() const { return smallest_radius_; }

 private:
  struct RoundCone {
    Vec3 a, b;
    double radius_a, radius_b;
    Sample distance(const Vec3& x) const;
  };
  struct Tube {
    std::vector<RoundCone> cones;
    Eigen::AlignedBox3d bounds;
    double blend;
  };

  Tube tube_of(const Branch& branch);
  static void add_cone(Tube& tube, const RoundCone& cone);
  void extend(Tube& tube, const OpenEnd& end);
  static Sample tube_distance(const Tube& tube, const Vec3& x);

  std::vector<Tube> tubes_;
  std::vector<OpenEnd> ends_;
  Eigen::AlignedBox3d bounds_;
  double smallest_radius_;
};

}  // namespace hexwall
