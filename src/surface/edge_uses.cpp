#include "surface/edge_uses.h"

#include <algorithm>
#include <tuple>

namespace hexwall {

std::vector<EdgeUse> edge_uses(const std::vector<std::array<int, 3>>& triangles) {
  int vertex_count = 0;
  for (const auto& t : triangles)
    vertex_count = std::max({vertex_count, t[0] + 1, t[1] + 1, t[2] + 1});
  // Counting puts uses in the order of their lower vertex, sorting those of one vertex is quick.
  std::vector<int> first(vertex_count + 1, 0);
  const auto for_each_use = [&triangles](auto&& visit) {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int a = triangles[f][k];
        const int b = triangles[f][(k + 1) % 3];
        visit(EdgeUse{std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
      }
    }
  };
  for_each_use([&](const EdgeUse& use) { ++first[use.low + 1]; });
  for (int v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  std::vector<EdgeUse> uses(3 * triangles.size());
  std::vector<int> next = first;
  for_each_use([&](const EdgeUse& use) { uses[next[use.low]++] = use; });
  for (int v = 0; v < vertex_count; ++v) {
    std::sort(uses.begin() + first[v], uses.begin() + first[v + 1],
              [](const EdgeUse& l, const EdgeUse& r) {
                return std::tie(l.high, l.face) < std::tie(r.high, r.face);
              });
  }
  return uses;
}

}  // namespace hexwall
