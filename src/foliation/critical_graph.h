#pragma once

#include <vector>

#include "foliation/level_curve.h"
#include "foliation/level_order.h"

namespace hexwall {

/// A piece of a critical level set between two junctions, running towards +x: above it (on its
/// left) y is greater. A boundary loop without half-zeros is one closed arc without junctions.
struct Arc {
  LevelCurve curve;        ///< x from 0 to the length of the arc
  int component = -1;      ///< of the critical graph
  bool has_upper = false;  ///< the surface continues above; false on parts of boundary loops
  bool has_lower = false;
  int from = -1, to = -1;  ///< junctions; -1 for a closed arc without any
  /// Sectors in which the arc starts and ends, on its upper and its lower side; -1 where none.
  int upper_start = -1, upper_end = -1, lower_start = -1, lower_end = -1;

  bool is_plain_loop() const { return from < 0; }
};

/// A maximal run of neighbours of a junction on one side of its level. One arc ends and one arc
/// starts along its two sides, and one vertical critical trajectory leaves through it.
struct Sector {
  int junction = -1;
  bool is_upper = false;
  int in_arc = -1;
  int out_arc = -1;
};

/// A zero of the form as a node of the critical graph: its sectors, counter-clockwise.
struct Junction {
  int vertex = -1;
  int component = -1;
  std::vector<int> spokes;        ///< outgoing half-edges to neighbours of other rank
  std::vector<int> spoke_sector;  ///< sector of each spoke

  int sector_of(int spoke) const;  ///< sector that holds an outgoing half-edge
};

/// One connected piece of a critical level set: a boundary loop together with the arcs that leave
/// its half-zeros, or an interior zero together with its arcs.
struct CriticalComponent {
  int loop = -1;  ///< boundary loop, -1 for an interior zero
  int rank = -1;
  double y = 0.0;
  std::vector<int> arcs;
};

/// Where a critical level set crosses an edge of the mesh.
struct EdgeCrossing {
  int edge;
  int rank;
  int arc;
  int index;  ///< of the point on the arc
};

/// A position on the critical graph: on an arc, at one of its points.
struct GraphPosition {
  int arc = -1;
  int index = 0;
};

/// All critical level sets: the closed loops of the boundary, and the singular curves through the
/// zeros. Cutting along them leaves cylinders.
struct CriticalGraph {
  std::vector<Zero> zeros;
  std::vector<CriticalComponent> components;  ///< loop i is component i, then interior zeros
  std::vector<Junction> junctions;
  std::vector<Sector> sectors;
  std::vector<Arc> arcs;
  std::vector<EdgeCrossing> crossings;       ///< sorted by edge, then rank
  std::vector<int> junction_of_vertex;       ///< #V, -1 for ordinary vertices
  std::vector<GraphPosition> loop_position;  ///< #V position of ordinary loop vertices

  /// Crossings of one edge, by rising rank: [first, last) in `crossings`.
  std::pair<std::size_t, std::size_t> crossings_of(int edge) const;
};

/// \throws MeshingError as `find_zeros`.
CriticalGraph critical_graph(const Connectivity& mesh, const HolomorphicForm& form,
                             const std::vector<int>& ranks);

}  // namespace hexwall
