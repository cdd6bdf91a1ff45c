#include "hex/skewness.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "hex/cell_geometry.h"

namespace hexwall {
namespace {

double of_face(const Face& face, const Vec3& owner, const Vec3& neighbour) {
  return skewness_between(face, face_geometry(face), owner, neighbour);
}

}  // namespace

Skewness::Skewness(const QuadMesh& quads, std::vector<double> levels)
    : quads_(quads.quads),
      levels_(std::move(levels)),
      layers_(std::ssize(levels_) - 1),
      edges_(edges_with_quads(quads)),
      centers_(quads.quads.size() * layers_),
      of_column_(quads.quads.size()),
      above_edge_(edges_.size()) {}

void Skewness::find_centers(int q) {
  for (int layer = 0; layer < layers_; ++layer) {
    std::array<Vec3, 8> hex;
    for (int k = 0; k < 4; ++k) {
      hex[k] = point(quads_[q][k], layer);
      hex[k + 4] = point(quads_[q][k], layer + 1);
    }
    centers_[q * layers_ + layer] = cell_center(hex);
  }
}

double Skewness::of_column(int q) const {
  double worst = 0.0;
  for (int level = 0; level <= layers_; ++level) {
    Face face;
    for (int k = 0; k < 4; ++k) face[k] = point(quads_[q][k], level);
    if (level == 0 || level == layers_) {
      worst = std::max(worst, skewness_at_boundary(face, face_geometry(face),
                                                   center(q, level == 0 ? 0 : level - 1)));
    } else {
      worst = std::max(worst, of_face(face, center(q, level - 1), center(q, level)));
    }
  }
  return worst;
}

double Skewness::above_edge(const QuadEdge& edge) const {
  double worst = 0.0;
  const auto [a, b] = edge.vertices;
  for (int layer = 0; layer < layers_; ++layer) {
    const Face face{point(a, layer), point(b, layer), point(b, layer + 1), point(a, layer + 1)};
    const Vec3& owner = center(edge.quads[0], layer);
    worst =
        std::max(worst, edge.quads[1] < 0 ? skewness_at_boundary(face, face_geometry(face), owner)
                                          : of_face(face, owner, center(edge.quads[1], layer)));
  }
  return worst;
}

std::vector<int> Skewness::quads_above(double limit, const std::vector<ColumnEdge>& columns) {
  const std::vector<char> at_vertex = changes(columns_, columns);
  columns_ = columns;
  std::vector<char> changed(quads_.size());
  parallel_for(changed.size(), [&](std::size_t q) {
    const auto& quad = quads_[q];
    changed[q] =
        std::any_of(quad.begin(), quad.end(), [&](int v) { return at_vertex[v] != 0; }) ? 1 : 0;
    if (changed[q] == 0) return;
    find_centers(static_cast<int>(q));
    of_column_[q] = of_column(static_cast<int>(q));
  });
  parallel_for(edges_.size(), [&](std::size_t e) {
    const auto& [q, r] = edges_[e].quads;
    if (changed[q] != 0 || (r >= 0 && changed[r] != 0)) above_edge_[e] = above_edge(edges_[e]);
  });
  std::vector<char> is_skewed(changed.size());
  for (std::size_t q = 0; q < is_skewed.size(); ++q) is_skewed[q] = of_column_[q] > limit ? 1 : 0;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (!(above_edge_[e] > limit)) continue;
    for (const int q : edges_[e].quads) {
      if (q >= 0) is_skewed[q] = 1;
    }
  }
  std::vector<int> result;
  for (std::size_t q = 0; q < is_skewed.size(); ++q) {
    if (is_skewed[q] != 0) result.push_back(static_cast<int>(q));
  }
  return result;
}

}  // namespace hexwall
