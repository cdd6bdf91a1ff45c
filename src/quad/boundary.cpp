#include "quad/boundary.h"

#include <algorithm>
#include <tuple>

namespace hexwall {

std::array<int, 2> ends_of(const QuadMesh& mesh, const QuadSide& side) {
  const auto& quad = mesh.quads[side.quad];
  return {quad[side.side], quad[(side.side + 1) % 4]};
}

std::vector<QuadSide> boundary_sides(const QuadMesh& mesh) {
  struct Entry {
    std::array<int, 2> edge;
    std::array<int, 2> place;
  };
  std::vector<Entry> entries;
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) {
      const auto [low, high] = std::minmax(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4]);
      if (mesh.loop_of_vertex[low] < 0 || mesh.loop_of_vertex[high] < 0) continue;
      entries.push_back({{low, high}, {q, k}});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.edge, a.place) < std::tie(b.edge, b.place);
  });
  std::vector<QuadSide> sides;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool twice = (i > 0 && entries[i - 1].edge == entries[i].edge) ||
                       (i + 1 < entries.size() && entries[i + 1].edge == entries[i].edge);
    if (!twice) sides.push_back({entries[i].place[0], entries[i].place[1]});
  }
  std::sort(sides.begin(), sides.end(), [](const QuadSide& a, const QuadSide& b) {
    return std::tie(a.quad, a.side) < std::tie(b.quad, b.side);
  });
  return sides;
}

}  // namespace hexwall
