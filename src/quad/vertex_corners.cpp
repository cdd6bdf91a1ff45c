#include "quad/vertex_corners.h"

#include <numeric>

namespace hexwall {

VertexCorners::VertexCorners(const QuadMesh& mesh)
    : first_(mesh.points.size() + 1, 0), corners_(4 * mesh.quads.size()) {
  for (const auto& quad : mesh.quads) {
    for (const int v : quad) ++first_[v + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) corners_[next[mesh.quads[q][k]]++] = {q, k};
  }
}

}  // namespace hexwall
