#include "surface/connectivity.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {

Connectivity::Connectivity(int vertex_count, std::vector<std::array<int, 3>> triangles)
    : triangles_(std::move(triangles)), outgoing_(vertex_count, -1) {
  match_halfedges();
  number_edges();
  find_fans();
  find_loops();
}

void Connectivity::match_halfedges() {
  std::vector<int> first(outgoing_.size() + 1, 0);
  for (int h = 0; h < halfedge_count(); ++h) ++first[tail(h) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> from(halfedge_count());  // half-edges by their tails
  std::vector<int> end(first.begin(), first.end() - 1);
  for (int h = 0; h < halfedge_count(); ++h) from[end[tail(h)]++] = h;
  twin_.assign(halfedge_count(), -1);
  // At one vertex after the other: the half-edge from it to each of its neighbours.
  std::vector<int> to(outgoing_.size(), -1);
  for (int v = 0; v < vertex_count(); ++v) {
    for (int i = first[v]; i < first[v + 1]; ++i) {
      const int other = std::exchange(to[tip(from[i])], from[i]);
      if (other >= 0 && tail(other) == v) refuse_edge(other, from[i]);
    }
    for (int i = first[v]; i < first[v + 1]; ++i) {
      const int incoming = prev(from[i]);
      const int twin = to[tail(incoming)];
      if (twin >= 0 && tail(twin) == v && tail(incoming) != v) twin_[incoming] = twin;
    }
  }
}

// Two half-edges go the same way.
void Connectivity::refuse_edge(int g, int h) const {
  const auto [low, high] = std::minmax({tail(g), tip(g)});
  int uses = 0;
  for (int i = 0; i < halfedge_count(); ++i) {
    if (std::minmax({tail(i), tip(i)}) == std::pair(low, high)) ++uses;
  }
  if (uses > 2) {
    throw TopologyError(fmt::format("edge ({}, {}) belongs to {} triangles: at most 2 are possible",
                                    low, high, uses));
  }
  throw TopologyError(
      fmt::format("triangles {} and {} disagree in their orientation at edge ({}, {})", face(g),
                  face(h), low, high));
}

void Connectivity::number_edges() {
  edge_of_.assign(halfedge_count(), -1);
  for (int h = 0; h < halfedge_count(); ++h) {
    if (twin_[h] >= 0 && twin_[h] < h) {
      edge_of_[h] = edge_of_[twin_[h]];
    } else {
      edge_of_[h] = edge_count();
      halfedge_of_edge_.push_back(h);
    }
  }
}

void Connectivity::find_fans() {
  std::vector<int> degree(outgoing_.size(), 0);
  for (int h = 0; h < halfedge_count(); ++h) {
    const int v = tail(h);
    ++degree[v];
    if (outgoing_[v] < 0 || twin_[h] < 0) outgoing_[v] = h;
  }
  for (int v = 0; v < vertex_count(); ++v) {
    int visited = 0;
    int h = outgoing_[v];
    while (h >= 0) {
      ++visited;
      h = rotate(h);
      if (h == outgoing_[v]) break;
    }
    if (visited != degree[v]) {
      throw TopologyError(fmt::format(
          "vertex {} joins several fans of triangles ({} of {} triangles are connected)", v,
          visited, degree[v]));
    }
  }
}

void Connectivity::find_loops() {
  loop_of_vertex_.assign(vertex_count(), -1);
  for (int start = 0; start < vertex_count(); ++start) {
    const int first = outgoing_[start];
    if (first < 0 || twin_[first] >= 0 || loop_of_vertex_[start] >= 0) continue;
    std::vector<int> loop;
    int v = start;
    do {
      loop_of_vertex_[v] = static_cast<int>(loops_.size());
      loop.push_back(v);
      v = tip(outgoing_[v]);
    } while (v != start);
    loops_.push_back(std::move(loop));
  }
}

void Connectivity::reorder_loops(const std::vector<int>& order) {
  std::vector<std::vector<int>> sorted;
  sorted.reserve(order.size());
  for (const int loop : order) sorted.push_back(std::move(loops_[loop]));
  loops_ = std::move(sorted);
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    for (const int v : loops_[i]) loop_of_vertex_[v] = static_cast<int>(i);
  }
}

int Connectivity::euler_number() const {
  const auto used = std::count_if(outgoing_.begin(), outgoing_.end(), [](int h) { return h >= 0; });
  return static_cast<int>(used) - edge_count() + face_count();
}

Connectivity connectivity_of(const TriangleSurface& surface) {
  return {static_cast<int>(surface.points.size()), surface.triangles};
}

}  // namespace hexwall
