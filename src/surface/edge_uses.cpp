#include "surface/edge_uses.h"

#include <algorithm>
#include <tuple>

namespace hexwall {

std::vector<EdgeUse> edge_uses(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[f][k];
      const int b = triangles[f][(k + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& l, const EdgeUse& r) {
    return std::tie(l.low, l.high, l.face) < std::tie(r.low, r.high, r.face);
  });
  return uses;
}

}  // namespace hexwall
