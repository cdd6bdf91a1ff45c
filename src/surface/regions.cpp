#include "surface/regions.h"

#include <algorithm>
#include <map>

#include "surface/edge_uses.h"

namespace hexwall {
namespace {

int side_of(const std::array<int, 3>& triangle, const EdgeUse& use) {
  const int tail = use.is_forward ? use.low : use.high;
  const int tip = use.is_forward ? use.high : use.low;
  for (int k = 0; k < 2; ++k) {
    if (triangle[k] == tail && triangle[k + 1] == tip) return k;
  }
  return 2;
}

}  // namespace

std::vector<FaceNeighbours> face_neighbours(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<FaceNeighbours> result(triangles.size(), {no_neighbour, no_neighbour, no_neighbour});
  for_each_edge(edge_uses(triangles), [&](auto first, auto last) {
    if (last - first == 1) return;
    for (auto use = first; use != last; ++use) {
      const int other = use == first ? first[1].face : first[0].face;
      result[use->face][side_of(triangles[use->face], *use)] =
          last - first == 2 ? other : many_neighbours;
    }
  });
  return result;
}

std::optional<std::vector<int>> single_cycle(const std::vector<std::array<int, 2>>& edges) {
  std::map<int, std::vector<int>> linked;
  for (const auto& [a, b] : edges) {
    linked[a].push_back(b);
    linked[b].push_back(a);
  }
  if (edges.size() < 3 || linked.size() != edges.size()) return std::nullopt;
  for (const auto& [vertex, others] : linked) {
    if (others.size() != 2 || others[0] == others[1]) return std::nullopt;
  }
  std::vector<int> cycle{linked.begin()->first, linked.begin()->second[0]};
  while (cycle.size() <= edges.size()) {
    const std::vector<int>& next = linked[cycle.back()];
    cycle.push_back(next[0] == cycle[cycle.size() - 2] ? next[1] : next[0]);
    if (cycle.back() == cycle.front()) break;
  }
  cycle.pop_back();
  if (cycle.size() != edges.size()) return std::nullopt;
  return cycle;
}

std::optional<Disk> as_disk(const TriangleSurface& surface,
                            const std::vector<FaceNeighbours>& neighbours,
                            std::vector<int> triangles) {
  std::vector<int> region = triangles;
  std::sort(region.begin(), region.end());
  Disk disk;
  std::vector<int> vertices;
  std::vector<std::array<int, 2>> edges;
  for (const int f : triangles) {
    const auto& t = surface.triangles[f];
    vertices.insert(vertices.end(), t.begin(), t.end());
    for (int k = 0; k < 3; ++k) {
      const int g = neighbours[f][k];
      if (g < 0) return std::nullopt;
      if (std::binary_search(region.begin(), region.end(), g)) continue;
      disk.sides.push_back({f, k, g});
      edges.push_back({t[k], t[(k + 1) % 3]});
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const std::size_t doubled_edge_count = 3 * triangles.size() + edges.size();
  if (2 * vertices.size() + 2 * triangles.size() != doubled_edge_count + 2) return std::nullopt;
  auto rim = single_cycle(edges);
  if (!rim) return std::nullopt;
  disk.rim = std::move(*rim);
  disk.triangles = std::move(triangles);
  return disk;
}

Part part_of(const TriangleSurface& surface, const std::vector<int>& triangles) {
  Part part{{}, std::vector<int>(surface.points.size(), -1)};
  for (const int f : triangles) {
    for (const int v : surface.triangles[f]) part.number[v] = 0;
  }
  for (std::size_t v = 0; v < part.number.size(); ++v) {
    if (part.number[v] < 0) continue;
    part.number[v] = static_cast<int>(part.surface.points.size());
    part.surface.points.push_back(surface.points[v]);
  }
  part.surface.triangles.reserve(triangles.size());
  for (const int f : triangles) {
    const auto& [a, b, c] = surface.triangles[f];
    part.surface.triangles.push_back({part.number[a], part.number[b], part.number[c]});
  }
  return part;
}

}  // namespace hexwall
