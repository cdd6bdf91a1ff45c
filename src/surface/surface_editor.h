#pragma once

#include <array>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Local changes of a triangle surface that need not be manifold. Triangles and points keep their
/// numbers until `finish`.
class SurfaceEditor {
 public:
  /// Keeps references to both. \pre origin has one entry per triangle, and no triangle uses a
  /// vertex twice.
  SurfaceEditor(TriangleSurface& surface, std::vector<int>& origin);

  const std::array<int, 3>& triangle(int f) const { return surface_.triangles[f]; }
  int triangle_count() const { return static_cast<int>(surface_.triangles.size()); }
  bool is_alive(int f) const { return alive_[f]; }

  /// Triangles of vertex `v`, none of them removed.
  const std::vector<int>& faces(int v) const { return faces_[v]; }
  /// Triangles with the edge (a, b).
  std::vector<int> faces_at(int a, int b) const;
  /// Vertices that share an edge with `v`, in increasing order.
  std::vector<int> neighbours(int v) const;
  bool is_boundary_edge(int a, int b) const { return faces_at(a, b).size() == 1; }
  bool is_boundary_vertex(int v) const;

  /// Merging the ends of the edge (u, v) pinches no part of the surface: all vertices joined to
  /// both are opposite to the edge, and the edge does not connect two places of the boundary.
  bool can_merge(int u, int v) const;

  void remove(int f);
  int add(const std::array<int, 3>& triangle, int origin);
  /// Replaces `u` by `v` in all triangles, and removes those that then use `v` twice.
  void merge(int u, int v);

  /// Removes triangles for good, and the points that no triangle uses.
  void finish();

 private:
  TriangleSurface& surface_;
  std::vector<int>& origin_;
  std::vector<bool> alive_;
  std::vector<std::vector<int>> faces_;
};

/// Keeps the triangles for which `keep` holds, and the points they use, both in their order.
void keep_triangles(TriangleSurface& surface, std::vector<int>& origin,
                    const std::vector<bool>& keep);

/// The corner of a triangle that is neither `a` nor `b`.
int third_vertex(const std::array<int, 3>& triangle, int a, int b);

/// The triangle with `to` in the place of `from`.
std::array<int, 3> replaced(std::array<int, 3> triangle, int from, int to);

}  // namespace hexwall
