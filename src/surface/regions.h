#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "surface/triangle_surface.h"

/// Parts of a surface that need not be manifold or consistently wound.
namespace hexwall {

/// Neighbours of a triangle over its sides; side k runs from corner k to corner k + 1.
using FaceNeighbours = std::array<int, 3>;
inline constexpr int no_neighbour = -1;     ///< a boundary
inline constexpr int many_neighbours = -2;  ///< an edge with more than two triangles

/// #F.
std::vector<FaceNeighbours> face_neighbours(const std::vector<std::array<int, 3>>& triangles);

/// Grows regions of triangles over their sides, one after the other.
class RegionGrower {
 public:
  /// \param neighbours #F, to be kept by the caller.
  explicit RegionGrower(const std::vector<FaceNeighbours>& neighbours)
      : neighbours_(neighbours), region_of_(neighbours.size(), -1) {}

  /// Triangles reached from `seed` over sides whose far triangle `joins`. Starts with `seed`.
  template <class Joins>
  std::vector<int> grow(int seed, const Joins& joins) {
    ++last_;
    std::vector<int> region{seed};
    region_of_[seed] = last_;
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (const int g : neighbours_[region[i]]) {
        if (g < 0 || region_of_[g] == last_ || !joins(g)) continue;
        region_of_[g] = last_;
        region.push_back(g);
      }
    }
    return region;
  }

  /// Whether the triangle belongs to the last region.
  bool contains(int f) const { return region_of_[f] == last_; }

 private:
  const std::vector<FaceNeighbours>& neighbours_;
  std::vector<int> region_of_;  // #F number of the last region that took it
  int last_ = -1;
};

/// The one simple cycle that edges form, from its lowest vertex; nothing if they form another
/// graph.
std::optional<std::vector<int>> single_cycle(const std::vector<std::array<int, 2>>& edges);

/// A region that is a topological disk within the surface.
struct Disk {
  std::vector<int> triangles;
  std::vector<int> rim;  ///< vertex cycle, in either direction
  struct Side {
    int triangle, side, outside;
  };
  std::vector<Side> sides;  ///< along the rim, with the triangle on the other side
};

/// The disk that a region is: connected, Euler number 1, one simple rim with one triangle on the
/// other side of each edge. Nothing if it is none. \pre the region is connected over edges.
std::optional<Disk> as_disk(const TriangleSurface& surface,
                            const std::vector<FaceNeighbours>& neighbours,
                            std::vector<int> triangles);

struct Part {
  TriangleSurface surface;
  std::vector<int> number;  ///< of each vertex of the whole, -1 if it is not used
};

/// Some of the triangles of a surface, in the order given, with the points that they use.
Part part_of(const TriangleSurface& surface, const std::vector<int>& triangles);

}  // namespace hexwall
