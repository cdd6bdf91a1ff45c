#pragma once

#include <vector>

#include "foliation/critical_graph.h"
#include "foliation/cylinders.h"
#include "foliation/strips.h"

namespace hexwall {

/// The surface cut by the critical trajectories of a holomorphic form: cylinders along the
/// horizontal ones, strips along the vertical ones.
struct Foliation {
  std::vector<int> ranks;  ///< #V order of the vertices by y
  CriticalGraph graph;
  std::vector<Cylinder> cylinders;
  Strips strips;

  /// Twice the sum of the orders of all zeros: 2(n - 1).
  int doubled_order() const;
  int interior_zeros() const;  ///< with multiplicity
  int boundary_half_zeros() const;
  int corrected_arcs() const;  ///< arcs on which x had to be made monotone
};

/// \throws MeshingError as `find_zeros`.
Foliation foliate(const Connectivity& mesh, const HolomorphicForm& form);

}  // namespace hexwall
