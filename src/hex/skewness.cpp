#include "hex/skewness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "hex/cell_geometry.h"

namespace hexwall {
namespace {

double of_face(const Face& face, const Vec3& owner, const Vec3& neighbour) {
  return skewness_between(face, face_geometry(face), owner, neighbour);
}

/// Points and centres of the cells of all columns.
class Cells {
 public:
  Cells(const QuadMesh& quads, const std::vector<Vec3>& directions, const WallShape& shape,
        const std::vector<double>& levels)
      : quads_(quads),
        directions_(directions),
        shape_(shape),
        levels_(levels),
        layers_(static_cast<int>(levels.size()) - 1),
        centers_(quads.quads.size() * layers_) {
    parallel_for(quads.quads.size(), [&](std::size_t q) {
      for (int layer = 0; layer < layers_; ++layer) {
        std::array<Vec3, 8> hex;
        for (int k = 0; k < 4; ++k) {
          hex[k] = at(quads_.quads[q][k], layer);
          hex[k + 4] = at(quads_.quads[q][k], layer + 1);
        }
        centers_[q * layers_ + layer] = cell_center(hex);
      }
    });
  }

  // The greatest skewness of the faces between the layers of a column, and of its skins.
  double of_column(int q) const {
    double worst = 0.0;
    for (int level = 0; level <= layers_; ++level) {
      Face face;
      for (int k = 0; k < 4; ++k) face[k] = at(quads_.quads[q][k], level);
      if (level == 0 || level == layers_) {
        worst = std::max(worst, skewness_at_boundary(face, face_geometry(face),
                                                     center(q, level == 0 ? 0 : level - 1)));
      } else {
        worst = std::max(worst, of_face(face, center(q, level - 1), center(q, level)));
      }
    }
    return worst;
  }

  // The same of the faces above an edge, between two columns or, with a second quad of -1, in the
  // end ring.
  double above_edge(const std::array<int, 2>& edge, const std::array<int, 2>& quads) const {
    double worst = 0.0;
    for (int layer = 0; layer < layers_; ++layer) {
      const Face face{at(edge[0], layer), at(edge[1], layer), at(edge[1], layer + 1),
                      at(edge[0], layer + 1)};
      const Vec3& owner = center(quads[0], layer);
      worst = std::max(worst, quads[1] < 0 ? skewness_at_boundary(face, face_geometry(face), owner)
                                           : of_face(face, owner, center(quads[1], layer)));
    }
    return worst;
  }

 private:
  Vec3 at(int v, int level) const {
    return point_at(quads_.points[v], directions_[v],
                    shape_.outward.empty() ? 0.0 : shape_.outward[v],
                    shape_.inward.empty() ? 0.0 : shape_.inward[v], levels_[level]);
  }

  const Vec3& center(int q, int layer) const {
    return centers_[static_cast<std::size_t>(q) * layers_ + layer];
  }

  const QuadMesh& quads_;
  const std::vector<Vec3>& directions_;
  const WallShape& shape_;
  const std::vector<double>& levels_;
  int layers_;
  std::vector<Vec3> centers_;
};

}  // namespace

Skewness::Skewness(const QuadMesh& quads) : quads_(quads), edges_(edges_with_quads(quads)) {}

std::vector<int> Skewness::quads_above(double limit, const std::vector<Vec3>& directions,
                                       const WallShape& shape,
                                       const std::vector<double>& levels) const {
  const Cells cells(quads_, directions, shape, levels);
  std::vector<char> column_is_skewed(quads_.quads.size());
  parallel_for(column_is_skewed.size(), [&](std::size_t q) {
    column_is_skewed[q] = cells.of_column(static_cast<int>(q)) > limit ? 1 : 0;
  });
  std::vector<char> edge_is_skewed(edges_.size());
  parallel_for(edges_.size(), [&](std::size_t e) {
    edge_is_skewed[e] = cells.above_edge(edges_[e].vertices, edges_[e].quads) > limit ? 1 : 0;
  });
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edge_is_skewed[e] == 0) continue;
    for (const int q : edges_[e].quads) {
      if (q >= 0) column_is_skewed[q] = 1;
    }
  }
  std::vector<int> result;
  for (std::size_t q = 0; q < column_is_skewed.size(); ++q) {
    if (column_is_skewed[q] != 0) result.push_back(static_cast<int>(q));
  }
  return result;
}

}  // namespace hexwall
