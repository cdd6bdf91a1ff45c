#include "foliation/foliation.h"

#include <algorithm>

#include "core/cancel.h"

namespace hexwall {

int Foliation::doubled_order() const {
  int sum = 0;
  for (const Zero& zero : graph.zeros) sum += zero.doubled_order;
  return sum;
}

int Foliation::interior_zeros() const {
  return (doubled_order() - boundary_half_zeros()) / 2;
}

int Foliation::boundary_half_zeros() const {
  int sum = 0;
  for (const Zero& zero : graph.zeros) sum += zero.loop >= 0 ? zero.doubled_order : 0;
  return sum;
}

int Foliation::corrected_arcs() const {
  return static_cast<int>(std::count_if(graph.arcs.begin(), graph.arcs.end(),
                                        [](const Arc& arc) { return arc.curve.corrected; }));
}

Foliation foliate(const Connectivity& mesh, const HolomorphicForm& form) {
  throw_if_cancelled();
  Foliation result;
  result.ranks = level_ranks(mesh, form.y);
  result.graph = critical_graph(mesh, form, result.ranks);
  result.cylinders = find_cylinders(mesh, form, result.ranks, result.graph);
  result.strips = find_strips(result.graph, result.cylinders);
  return result;
}

}  // namespace hexwall
