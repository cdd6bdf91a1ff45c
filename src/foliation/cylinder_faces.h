#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "foliation/foliation.h"

namespace hexwall {

/// Visits all triangles that reach into cylinder `c`, each once, from neighbour to neighbour, with
/// x carried from corner to corner in the cylinder's coordinate: visit(f, x) with x of the three
/// corners of triangle f.
/// \param last_visit #F, scratch: which cylinder last visited each triangle; -1 at first.
template <class Visit>
void visit_cylinder(const Connectivity& mesh, const HolomorphicForm& form,
                    const Foliation& foliation, int c, std::vector<int>& last_visit,
                    const Visit& visit) {
  struct Visited {
    int face;
    std::array<double, 3> x;
  };
  const Cylinder& cylinder = foliation.cylinders[c];
  const int rank_low = foliation.graph.components[cylinder.bottom].rank;
  const int rank_high = foliation.graph.components[cylinder.top].rank;
  std::vector<Visited> queue;
  const auto enter = [&](int h, double x_tail) {
    Visited visited{Connectivity::face(h), {}};
    last_visit[visited.face] = c;
    for (int k = h % 3, count = 0; count < 3; ++count, k = (k + 1) % 3) {
      visited.x[k] = x_tail;
      x_tail += form.dx.along(mesh, 3 * visited.face + k);
    }
    queue.push_back(visited);
  };
  // Whether a part of the edge lies strictly inside the cylinder.
  const auto crosses = [&](int h) {
    const int a = foliation.ranks[mesh.tail(h)];
    const int b = foliation.ranks[mesh.tip(h)];
    return std::min(a, b) < rank_high && std::max(a, b) > rank_low;
  };
  enter(cylinder.path.front().halfedge, cylinder.path.front().x_tail);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Visited here = queue[i];
    visit(here.face, here.x);
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * here.face + k;
      const int twin = mesh.twin(h);
      if (twin < 0 || last_visit[Connectivity::face(twin)] == c || !crosses(h)) continue;
      enter(twin, here.x[(k + 1) % 3]);
    }
  }
}

}  // namespace hexwall
