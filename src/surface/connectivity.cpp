#include "surface/connectivity.h"

#include <algorithm>
#include <numeric>
#include <tuple>
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
  // Half-edges of an edge side by side: in buckets by their lower vertex, sorted within each.
  struct Key {
    int low, high, halfedge;
  };
  std::vector<int> bucket(outgoing_.size() + 1, 0);
  for (int h = 0; h < halfedge_count(); ++h) ++bucket[std::min(tail(h), tip(h)) + 1];
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<Key> keys(halfedge_count());
  std::vector<int> next(bucket.begin(), bucket.end() - 1);
  for (int h = 0; h < halfedge_count(); ++h) {
    const int low = std::min(tail(h), tip(h));
    keys[next[low]++] = {low, std::max(tail(h), tip(h)), h};
  }
  for (int v = 0; v < vertex_count(); ++v) {
    std::sort(keys.begin() + bucket[v], keys.begin() + bucket[v + 1],
              [](const Key& a, const Key& b) {
                return std::tie(a.high, a.halfedge) < std::tie(b.high, b.halfedge);
              });
  }
  twin_.assign(halfedge_count(), -1);
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t end = i + 1;
    while (end < keys.size() && keys[end].low == keys[i].low && keys[end].high == keys[i].high)
      ++end;
    if (end - i > 2) {
      throw TopologyError(
          fmt::format("edge ({}, {}) belongs to {} triangles: at most 2 are possible", keys[i].low,
                      keys[i].high, end - i));
    }
    if (end - i == 2) {
      const int g = keys[i].halfedge;
      const int h = keys[i + 1].halfedge;
      if (tail(g) == tail(h)) {
        throw TopologyError(
            fmt::format("triangles {} and {} disagree in their orientation at edge "
                        "({}, {})",
                        face(g), face(h), keys[i].low, keys[i].high));
      }
      twin_[g] = h;
      twin_[h] = g;
    }
    i = end;
  }
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

}  // namespace hexwall
