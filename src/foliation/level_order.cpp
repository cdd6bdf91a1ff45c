#include "foliation/level_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

// Sign changes of rank - rank(v) along the fan of v; neighbours of equal rank (on the same loop)
// are passed over. -1 if every neighbour lies on one side.
int sign_changes(const Connectivity& mesh, const std::vector<int>& ranks, int v) {
  int changes = 0;
  int first = 0;
  int last = 0;
  int h = mesh.outgoing(v);
  do {
    const int difference = ranks[mesh.tip(h)] - ranks[v];
    const int sign = (difference > 0) - (difference < 0);
    if (sign != 0) {
      if (last != 0 && sign != last) ++changes;
      if (first == 0) first = sign;
      last = sign;
    }
    h = mesh.rotate(h);
  } while (h >= 0 && h != mesh.outgoing(v));
  if (!mesh.is_boundary_vertex(v) && first != last) ++changes;
  return changes;
}

}  // namespace

std::vector<int> level_ranks(const Connectivity& mesh, const Eigen::VectorXd& y) {
  const auto key = [&](int v) {
    const int loop = mesh.loop_of_vertex(v);
    return std::pair{y[v], loop >= 0 ? mesh.loops()[loop].front() : v};
  };
  std::vector<int> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> ranks(order.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i) {
    ranks[order[i]] = ranks[order[i - 1]] + (key(order[i]) == key(order[i - 1]) ? 0 : 1);
  }
  return ranks;
}

std::vector<Zero> find_zeros(const Connectivity& mesh, const std::vector<int>& ranks) {
  std::vector<Zero> zeros;
  int doubled_total = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.outgoing(v) < 0) continue;
    const int changes = sign_changes(mesh, ranks, v);
    const int loop = mesh.loop_of_vertex(v);
    if (loop < 0 && changes == 0) {
      throw MeshingError(fmt::format(
          "the harmonic function has an extremum at interior vertex {}: the surface has a blind "
          "region too deep for double precision, or triangles too distorted; remesh it",
          v));
    }
    const int doubled_order = loop < 0 ? changes - 2 : changes;
    if (doubled_order > 0) zeros.push_back({v, loop, doubled_order});
    doubled_total += doubled_order;
  }
  const int expected = 2 * (static_cast<int>(mesh.loops().size()) - 2);
  if (doubled_total != expected) {
    throw MeshingError(fmt::format(
        "the zeros of the form have total order {}, expected {}: the surface is not a sphere with "
        "{} holes",
        0.5 * doubled_total, expected / 2, mesh.loops().size()));
  }
  return zeros;
}

}  // namespace hexwall
