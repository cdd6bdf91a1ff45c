#include "surface/handles.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace hexwall {
namespace {

// The line through the first root may run far to the handle and back; after this many moves of the
// root towards it, it no longer gets much shorter.
constexpr int root_moves = 4;

struct ClosedLine {
  std::vector<int> vertices;
  double length = std::numeric_limits<double>::max();
};

/// Shortest paths from a root along edges.
struct PathTree {
  std::vector<double> distance;
  std::vector<int> parent;  // #V half-edge from the vertex to the next one on its path; -1: root
};

PathTree shortest_paths(const TriangleSurface& surface, const Connectivity& mesh, int root) {
  PathTree tree{std::vector<double>(mesh.vertex_count(), std::numeric_limits<double>::max()),
                std::vector<int>(mesh.vertex_count(), -1)};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](int v, double distance, int edge) {
    if (distance >= tree.distance[v]) return;
    tree.distance[v] = distance;
    tree.parent[v] = edge;
    queue.emplace(distance, v);
  };
  reach(root, 0.0, -1);
  while (!queue.empty()) {
    const double distance = queue.top().first;
    const int v = queue.top().second;
    queue.pop();
    if (distance > tree.distance[v]) continue;
    for (int h = mesh.outgoing(v); h >= 0;) {
      const auto along = [&](int u, int e) {
        reach(u, distance + (surface.points[u] - surface.points[v]).norm(), e);
      };
      along(mesh.tip(h), mesh.edge(h));
      along(mesh.apex(h), mesh.edge(Connectivity::prev(h)));  // the last edge of a boundary vertex
      h = mesh.rotate(h);
      if (h == mesh.outgoing(v)) break;
    }
  }
  return tree;
}

/// The edges that neither the tree nor a spanning tree of the dual graph takes, shortest line last.
std::vector<int> leftover_edges(const Connectivity& mesh, const PathTree& tree,
                                const std::vector<double>& line_length) {
  std::vector<char> in_tree(mesh.edge_count(), 0);
  for (const int e : tree.parent) {
    if (e >= 0) in_tree[e] = 1;
  }
  std::vector<int> edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (in_tree[e] == 0) edges.push_back(e);
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [&](int a, int b) { return line_length[a] > line_length[b]; });
  // Nodes of the dual graph: the triangles, then the boundary loops.
  std::vector<int> root(mesh.face_count() + mesh.loops().size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int n) {
    while (root[n] != n) n = root[n] = root[root[n]];
    return n;
  };
  std::erase_if(edges, [&](int e) {
    const int h = mesh.halfedge(e);
    const int twin = mesh.twin(h);
    const int a = find(Connectivity::face(h));
    const int b = find(twin >= 0 ? Connectivity::face(twin)
                                 : mesh.face_count() + mesh.loop_of_vertex(mesh.tail(h)));
    root[a] = b;
    return a != b;
  });
  return edges;
}

/// The paths from both ends of an edge, up to where they meet.
std::vector<int> line_of(const Connectivity& mesh, const PathTree& tree, int edge) {
  const auto path_from = [&](int v) {
    std::vector<int> path{v};
    for (int e = tree.parent[v]; e >= 0; e = tree.parent[path.back()]) {
      const int h = mesh.halfedge(e);
      path.push_back(mesh.tail(h) == path.back() ? mesh.tip(h) : mesh.tail(h));
    }
    return path;
  };
  const int h = mesh.halfedge(edge);
  std::vector<int> line = path_from(mesh.tail(h));
  std::vector<int> other = path_from(mesh.tip(h));
  while (line.size() > 1 && other.size() > 1 && line[line.size() - 2] == other[other.size() - 2]) {
    line.pop_back();
    other.pop_back();
  }
  line.insert(line.end(), other.rbegin() + 1, other.rend());
  return line;
}

ClosedLine shortest_through(const TriangleSurface& surface, const Connectivity& mesh, int root) {
  const PathTree tree = shortest_paths(surface, mesh, root);
  std::vector<double> length(mesh.edge_count());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.tail(mesh.halfedge(e));
    const int b = mesh.tip(mesh.halfedge(e));
    length[e] =
        tree.distance[a] + tree.distance[b] + (surface.points[a] - surface.points[b]).norm();
  }
  const std::vector<int> edges = leftover_edges(mesh, tree, length);
  if (edges.empty()) return {};
  return {line_of(mesh, tree, edges.back()), length[edges.back()]};
}

}  // namespace

std::vector<int> handle_line(const TriangleSurface& surface, const Connectivity& mesh) {
  ClosedLine best;
  int root = surface.triangles.front()[0];
  for (int move = 0; move <= root_moves; ++move) {
    ClosedLine line = shortest_through(surface, mesh, root);
    if (line.vertices.empty() || line.length >= best.length) break;
    best = std::move(line);
    root = best.vertices.front();  // an end of the edge that closes it: the farthest from the root
  }
  return best.vertices;
}

}  // namespace hexwall
