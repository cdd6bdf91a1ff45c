#pragma once

#include <array>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Half-edge connectivity of an oriented manifold triangle mesh with boundary.
///
/// Half-edge `h = 3 f + k` runs in triangle `f` from corner `k` to corner `k + 1`, with the
/// triangle on its left. Edges are numbered; an edge's orientation is that of `halfedge(e)`,
/// its half-edge of lowest number.
class Connectivity {
 public:
  Connectivity() = default;

  /// \pre each vertex index lies in [0, vertex_count).
  /// \throws TopologyError if an edge has more than two triangles, two triangles traverse an edge
  /// in the same direction, or a vertex has more than one fan of triangles.
  Connectivity(int vertex_count, std::vector<std::array<int, 3>> triangles);

  int vertex_count() const { return static_cast<int>(outgoing_.size()); }
  int face_count() const { return static_cast<int>(triangles_.size()); }
  int edge_count() const { return static_cast<int>(halfedge_of_edge_.size()); }
  int halfedge_count() const { return 3 * face_count(); }

  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }

  static int face(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int prev(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  int tail(int h) const { return triangles_[h / 3][h % 3]; }
  int tip(int h) const { return tail(next(h)); }
  int apex(int h) const { return tail(prev(h)); }  ///< the corner opposite to `h`

  int twin(int h) const { return twin_[h]; }  ///< -1 on the boundary
  int edge(int h) const { return edge_of_[h]; }
  int halfedge(int e) const { return halfedge_of_edge_[e]; }
  double sign(int h) const { return halfedge(edge(h)) == h ? 1.0 : -1.0; }
  bool is_boundary_edge(int e) const { return twin_[halfedge_of_edge_[e]] < 0; }
  bool is_boundary_vertex(int v) const { return loop_of_vertex_[v] >= 0; }

  /// Half-edge that starts at `v`; at a boundary vertex the one along the boundary, so that
  /// repeated `rotate` visits every triangle of `v`. -1 for a vertex without triangles.
  int outgoing(int v) const { return outgoing_[v]; }
  /// The next half-edge counter-clockwise around `tail(h)`; -1 past the boundary.
  int rotate(int h) const { return twin_[prev(h)]; }

  /// Boundary loops as vertex cycles, each with the surface on its left.
  const std::vector<std::vector<int>>& loops() const { return loops_; }
  /// Loop of a vertex, -1 for an interior vertex.
  int loop_of_vertex(int v) const { return loop_of_vertex_[v]; }
  int euler_number() const;

  /// Renumbers the loops: loop `i` is the former loop `order[i]`.
  void reorder_loops(const std::vector<int>& order);

 private:
  void match_halfedges();
  [[noreturn]] void refuse_edge(int g, int h) const;
  void number_edges();
  void find_fans();
  void find_loops();

  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> twin_, edge_of_, halfedge_of_edge_, outgoing_, loop_of_vertex_;
  std::vector<std::vector<int>> loops_;
};

/// \throws TopologyError as the constructor. \pre each vertex index lies in [0, #V).
Connectivity connectivity_of(const TriangleSurface& surface);

}  // namespace hexwall
