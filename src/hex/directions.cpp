#include "hex/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "quad/quality.h"
#include "quad/vertex_corners.h"

namespace hexwall {
namespace {

// Columns better than this need no smoothing: above what extrusion wants (0.2) and what a face
// needs to be split (0).
constexpr double good_scaled_jacobian = 0.35;
constexpr double good_face_split = 0.1;
// Smoothing never tilts a direction so far that a thin wall would fall below this.
constexpr double least_steepness = 0.4;
// Patches grow by a ring of vertices a round: no bad column needs its surroundings from further.
constexpr int most_rounds = 100;

// Where a loop cuts the surface more obliquely than this (in radians), a flat ring would shear the
// columns so much that thin layers get skewed faces.
constexpr double greatest_tilt = 45.0 * std::numbers::pi / 180.0;

// The direction turned about the loop, so that its component along the plane's normal is `height`.
Vec3 turned_to(const Vec3& direction, const LoopPlane& plane, double height) {
  const Vec3 flat = direction - direction.dot(plane.normal) * plane.normal;
  if (flat.norm() < 1e-6) return direction;
  return std::sqrt(std::max(0.0, 1.0 - height * height)) * flat.normalized() +
         height * plane.normal;
}

// Tilts a normal of the surface into the plane if it is not too far from it, and the less the
// farther beyond: a flat surface (an annulus in the plane of its loops) keeps its normals.
Vec3 flattened(const Vec3& normal, const LoopPlane& plane) {
  const double height = normal.dot(plane.normal);
  const double angle = std::asin(std::clamp(std::abs(height), 0.0, 1.0));
  if (angle <= greatest_tilt) return turned_to(normal, plane, 0.0);
  constexpr double right_angle = 0.5 * std::numbers::pi;
  const double tilt = greatest_tilt * (right_angle - angle) / (right_angle - greatest_tilt);
  return turned_to(normal, plane, std::copysign(std::sin(angle - tilt), height));
}

class Smoother {
 public:
  Smoother(const QuadMesh& quads, const std::vector<LoopPlane>& planes, const WallShape& shape,
           std::vector<Vec3>& directions)
      : quads_(quads),
        planes_(planes),
        shape_(shape),
        directions_(directions),
        first_neighbour_(directions.size() + 1, 0),
        corners_(quads),
        bad_(quads.quads.size(), 1) {
    find_neighbours();
  }

  int run() {
    std::vector<char> ever(directions_.size(), 0);
    std::vector<char> marked(directions_.size(), 1);
    for (int round = 0; round < most_rounds; ++round) {
      marked = around_bad_columns(marked);
      if (std::find(marked.begin(), marked.end(), 1) == marked.end()) break;
      average(marked);
      for (std::size_t v = 0; v < ever.size(); ++v) ever[v] = ever[v] != 0 || marked[v] != 0;
    }
    return static_cast<int>(std::count(ever.begin(), ever.end(), 1));
  }

 private:
  // In ascending order, as the edges are.
  void find_neighbours() {
    const std::vector<std::array<int, 2>> edges = edges_of(quads_);
    for (const auto& [a, b] : edges) {
      ++first_neighbour_[a + 1];
      ++first_neighbour_[b + 1];
    }
    std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
    neighbours_.resize(first_neighbour_.back());
    std::vector<int> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
    for (const auto& [a, b] : edges) {
      neighbours_[next[a]++] = b;
      neighbours_[next[b]++] = a;
    }
  }

  bool is_bad(std::size_t q) const {
    const Column column = column_of(quads_, static_cast<int>(q), directions_, shape_);
    // A quad that is itself poor can't give better hexes.
    const double attainable = 0.9 * scaled_jacobian(column.base);
    return scaled_jacobian(column, shape_.plan.levels) <
               std::min(good_scaled_jacobian, attainable) ||
           face_split(column, shape_.plan.levels) < good_face_split;
  }

  // Vertices of bad columns and their neighbours. Only columns of `changed` vertices are looked at
  // again.
  std::vector<char> around_bad_columns(const std::vector<char>& changed) {
    parallel_for(bad_.size(), [&](std::size_t q) {
      const auto& quad = quads_.quads[q];
      if (std::any_of(quad.begin(), quad.end(), [&](int v) { return changed[v] != 0; })) {
        bad_[q] = is_bad(q) ? 1 : 0;
      }
    });
    std::vector<char> core(directions_.size(), 0);
    for (std::size_t q = 0; q < bad_.size(); ++q) {
      if (bad_[q] == 0) continue;
      for (const int v : quads_.quads[q]) core[v] = 1;
    }
    std::vector<char> marked = core;
    for (std::size_t v = 0; v < core.size(); ++v) {
      if (core[v] == 0) continue;
      for (const int w : neighbours_of(v)) marked[w] = 1;
    }
    return marked;
  }

  void average(const std::vector<char>& marked) {
    const std::vector<Vec3> before = directions_;
    parallel_for(directions_.size(), [&](std::size_t v) {
      if (marked[v] == 0) return;
      Vec3 direction = before[v];
      for (const int w : neighbours_of(v)) direction += before[w];
      direction.normalize();
      const int loop = quads_.loop_of_vertex[v];
      if (loop >= 0 && planes_[loop].is_planar()) {
        direction = turned_to(direction, planes_[loop], before[v].dot(planes_[loop].normal));
      }
      const double least = std::min(least_steepness, steepness(v, before[v]));
      if (steepness(v, direction) >= least) directions_[v] = direction;
    });
  }

  std::span<const int> neighbours_of(std::size_t v) const {
    return {neighbours_.begin() + first_neighbour_[v],
            neighbours_.begin() + first_neighbour_[v + 1]};
  }

  // Least scaled Jacobian that a direction gives at the corners around a vertex, for a thin wall.
  double steepness(std::size_t v, const Vec3& direction) const {
    double least = 1.0;
    for (const auto& [q, k] : corners_.at(v)) {
      const auto p = corners_of(quads_, q);
      const Vec3 u = (p[(k + 1) % 4] - p[k]).normalized();
      least = std::min(least, u.cross((p[(k + 3) % 4] - p[k]).normalized()).dot(direction));
    }
    return least;
  }

  const QuadMesh& quads_;
  const std::vector<LoopPlane>& planes_;
  const WallShape& shape_;
  std::vector<Vec3>& directions_;
  std::vector<int> first_neighbour_, neighbours_;  // of each vertex
  VertexCorners corners_;
  std::vector<char> bad_;  // #Q
};

}  // namespace

void flatten_at_loops(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      std::vector<Vec3>& directions) {
  for (std::size_t v = 0; v < directions.size(); ++v) {
    const int loop = quads.loop_of_vertex[v];
    if (loop >= 0 && planes[loop].is_planar()) {
      directions[v] = flattened(directions[v], planes[loop]);
    }
  }
}

int smooth_directions(const QuadMesh& quads, const std::vector<LoopPlane>& planes,
                      const WallShape& shape, std::vector<Vec3>& directions) {
  return Smoother(quads, planes, shape, directions).run();
}

}  // namespace hexwall
