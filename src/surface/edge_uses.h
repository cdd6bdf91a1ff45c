#pragma once

#include <array>
#include <vector>

namespace hexwall {

/// One side of one triangle, of a mesh that need not be manifold.
struct EdgeUse {
  int low, high;    ///< the edge's vertices, low < high
  int face;         ///< triangle
  bool is_forward;  ///< the triangle traverses the edge from `low` to `high`
};

/// The sides of all triangles, sorted by edge and then by triangle. 3 #F entries.
std::vector<EdgeUse> edge_uses(const std::vector<std::array<int, 3>>& triangles);

/// Calls `visit(first, last)` for the range of uses of each edge in turn.
template <typename Visitor>
void for_each_edge(const std::vector<EdgeUse>& uses, Visitor&& visit) {
  for (auto first = uses.begin(); first != uses.end();) {
    auto last = first + 1;
    while (last != uses.end() && last->low == first->low && last->high == first->high) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace hexwall
