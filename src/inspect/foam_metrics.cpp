#include "inspect/foam_metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

namespace hexwall {
namespace {

constexpr double tiny = 1e-150;  // OpenFOAM's ROOTVSMALL
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Geometry as OpenFOAM takes it (primitiveMesh::calcFaceCentresAndAreas, calcCellCentresAndVols).
struct Geometry {
  std::vector<Vec3> face_center, face_area;
  std::vector<Vec3> cell_center;
  std::vector<double> cell_volume;
};

void add_face(const FaceMesh& faces, const std::vector<Vec3>& points, int f, Geometry& g) {
  const auto face = faces.face(f);
  const std::size_t n = face.size();
  const Vec3 middle = center_of_face(faces, points, f);
  Vec3 area = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  double weights = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3& a = points[face[k]];
    const Vec3& b = points[face[(k + 1) % n]];
    const Vec3 doubled = (b - a).cross(middle - a);
    area += 0.5 * doubled;
    center += doubled.norm() * (a + b + middle) / 3.0;
    weights += doubled.norm();
  }
  g.face_area.push_back(area);
  g.face_center.push_back(n > 3 && weights > 0.0 ? Vec3(center / weights) : middle);
}

// Calls visit(cell, sign) for the owner (+1) and the neighbour (-1) of a face.
template <typename Visit>
void for_cells(const FaceMesh& faces, int f, const Visit& visit) {
  visit(faces.owner[f], 1.0);
  if (faces.neighbour[f] >= 0) visit(faces.neighbour[f], -1.0);
}

void add_cells(const FaceMesh& faces, Geometry& g) {
  std::vector<Vec3> middle(faces.cells, Vec3::Zero());
  std::vector<int> sides(faces.cells, 0);
  for (int f = 0; f < faces.size(); ++f) {
    for_cells(faces, f, [&](int cell, double) {
      middle[cell] += g.face_center[f];
      ++sides[cell];
    });
  }
  g.cell_center.assign(faces.cells, Vec3::Zero());
  g.cell_volume.assign(faces.cells, 0.0);
  for (int c = 0; c < faces.cells; ++c) middle[c] /= std::max(1, sides[c]);
  for (int f = 0; f < faces.size(); ++f) {
    for_cells(faces, f, [&](int cell, double sign) {
      const double pyramid = sign * g.face_area[f].dot(g.face_center[f] - middle[cell]);
      g.cell_center[cell] += pyramid * (0.75 * g.face_center[f] + 0.25 * middle[cell]);
      g.cell_volume[cell] += pyramid;
    });
  }
  for (int c = 0; c < faces.cells; ++c) {
    if (std::abs(g.cell_volume[c]) > 1e-300) {
      g.cell_center[c] /= g.cell_volume[c];
    } else {
      g.cell_center[c] = middle[c];
    }
    g.cell_volume[c] /= 3.0;
  }
}

class Measures {
 public:
  Measures(const FaceMesh& faces, const std::vector<Vec3>& points)
      : faces_(faces), points_(points) {
    for (int f = 0; f < faces.size(); ++f) add_face(faces, points, f, g_);
    add_cells(faces, g_);
    sum_areas();
  }

  double non_orthogonality(int f) const {
    return is_internal(f) ? degrees_of_cosine(cosine(f)) : none;
  }

  // As checkMesh says it: the angle of the mean cosine.
  double mean_non_orthogonality() const {
    double sum = 0.0;
    int count = 0;
    for (int f = 0; f < faces_.size(); ++f) {
      if (!is_internal(f)) continue;
      sum += cosine(f);
      ++count;
    }
    return count == 0 ? 0.0 : degrees_of_cosine(sum / count);
  }

  double skewness(int f) const {
    const Vec3 to_face = g_.face_center[f] - g_.cell_center[faces_.owner[f]];
    const Vec3 normal = g_.face_area[f].normalized();
    const Vec3 d = is_internal(f) ? between(f) : Vec3(normal.dot(to_face) * normal);
    const Vec3 offset =
        to_face - g_.face_area[f].dot(to_face) / (g_.face_area[f].dot(d) + tiny) * d;
    const Vec3 direction = offset / (offset.norm() + tiny);
    double extent = (is_internal(f) ? 0.2 : 0.4) * d.norm() + tiny;
    for (const int v : faces_.face(f)) {
      extent = std::max(extent, std::abs(direction.dot(points_[v] - g_.face_center[f])));
    }
    return offset.norm() / extent;
  }

  double weight(int f) const {
    if (!is_internal(f)) return none;
    const auto height = [&](int cell) {
      return std::abs(g_.face_area[f].dot(g_.face_center[f] - g_.cell_center[cell]));
    };
    const double own = height(faces_.owner[f]);
    const double next = height(faces_.neighbour[f]);
    return std::min(own, next) / (own + next + tiny);
  }

  double volume_ratio(int f) const {
    if (!is_internal(f)) return none;
    const double own = std::abs(g_.cell_volume[faces_.owner[f]]);
    const double next = std::abs(g_.cell_volume[faces_.neighbour[f]]);
    return std::min(own, next) / (std::max(own, next) + tiny);
  }

  double flatness(int f) const {
    const auto face = faces_.face(f);
    if (face.size() < 4 || g_.face_area[f].norm() <= tiny) return none;
    double sum = 0.0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3& a = points_[face[k]];
      const Vec3& b = points_[face[(k + 1) % face.size()]];
      sum += 0.5 * (b - a).cross(g_.face_center[f] - a).norm();
    }
    return g_.face_area[f].norm() / (sum + tiny);
  }

  double pyramid(int f) const {
    double least = std::numeric_limits<double>::max();
    for_cells(faces_, f, [&](int cell, double sign) {
      const Vec3 up = g_.face_center[f] - g_.cell_center[cell];
      least = std::min(least, sign * g_.face_area[f].dot(up) / 3.0);
    });
    return least;
  }

  // The least volume of the tets that a face makes with the centres of its cells: with its own
  // centre, and split from whichever of its vertices is best for both cells.
  double face_tets(int f) const {
    const auto face = faces_.face(f);
    const std::size_t n = face.size();
    double around_center = std::numeric_limits<double>::max();
    double best = -std::numeric_limits<double>::max();
    for (std::size_t base = 0; base < n; ++base) {
      const Vec3& a = points_[face[base]];
      const Vec3& next = points_[face[(base + 1) % n]];
      around_center = std::min(around_center, least_tet(f, g_.face_center[f], a, next));
      double least = std::numeric_limits<double>::max();
      for (std::size_t k = 1; k + 1 < n; ++k) {
        const Vec3& b = points_[face[(base + k) % n]];
        const Vec3& c = points_[face[(base + k + 1) % n]];
        least = std::min(least, least_tet(f, a, b, c));
      }
      best = std::max(best, least);
    }
    return std::min(best, around_center);
  }

  double openness(int c) const {
    return (area_[c].cwiseAbs().array() / (area_magnitude_[c].array() + tiny)).maxCoeff();
  }

  double aspect_ratio(int c) const {
    const Vec3& m = area_magnitude_[c];
    const double volume = std::max(tiny, g_.cell_volume[c]);
    return std::max(m.maxCoeff() / (m.minCoeff() + tiny),
                    m.sum() / 6.0 / std::cbrt(volume * volume));
  }

  double determinant(int c) const {
    if (internal_faces_[c] == 0) return 0.0;
    const double mean = internal_area_[c] / internal_faces_[c];
    constexpr double of_cube = 8.0;
    return std::abs((tensor_[c] / (mean * mean)).determinant()) / of_cube;
  }

  double volume(int c) const { return g_.cell_volume[c]; }

 private:
  bool is_internal(int f) const { return faces_.neighbour[f] >= 0; }

  static double degrees_of_cosine(double x) {
    return std::acos(std::clamp(x, -1.0, 1.0)) * 180.0 / std::numbers::pi;
  }

  double cosine(int f) const {
    const Vec3 d = between(f);
    return d.dot(g_.face_area[f]) / (d.norm() * g_.face_area[f].norm() + tiny);
  }

  // Of the tets of a triangle of the face and the centre of either cell.
  double least_tet(int f, const Vec3& a, const Vec3& b, const Vec3& c) const {
    double least = std::numeric_limits<double>::max();
    for_cells(faces_, f, [&](int cell, double sign) {
      const Vec3& from = g_.cell_center[cell];
      least = std::min(least, sign * (a - from).cross(b - from).dot(c - from) / 6.0);
    });
    return least;
  }

  Vec3 between(int f) const {
    return g_.cell_center[faces_.neighbour[f]] - g_.cell_center[faces_.owner[f]];
  }

  void sum_areas() {
    area_.assign(faces_.cells, Vec3::Zero());
    area_magnitude_.assign(faces_.cells, Vec3::Zero());
    tensor_.assign(faces_.cells, Eigen::Matrix3d::Zero());
    internal_area_.assign(faces_.cells, 0.0);
    internal_faces_.assign(faces_.cells, 0);
    for (int f = 0; f < faces_.size(); ++f) {
      const Vec3& area = g_.face_area[f];
      for_cells(faces_, f, [&](int cell, double sign) {
        area_[cell] += sign * area;
        area_magnitude_[cell] += area.cwiseAbs();
        if (!is_internal(f)) return;
        tensor_[cell] += area * area.transpose();
        internal_area_[cell] += area.norm();
        ++internal_faces_[cell];
      });
    }
  }

  const FaceMesh& faces_;
  const std::vector<Vec3>& points_;
  Geometry g_;
  std::vector<Vec3> area_, area_magnitude_;  ///< of each cell: sum over its faces, of magnitudes
  std::vector<Eigen::Matrix3d> tensor_;      ///< of internal faces
  std::vector<double> internal_area_;
  std::vector<int> internal_faces_;
};

// Statistics of value(i) over i in [0, count).
void fill(FoamMetric& metric, int count, const std::function<double(int)>& value) {
  metric.min = std::numeric_limits<double>::max();
  metric.max = -metric.min;
  const auto is_worse = [&](double a, double b) { return metric.low_is_bad ? a < b : a > b; };
  double worst = 0.0;
  std::vector<std::pair<double, int>> beyond;
  for (int i = 0; i < count; ++i) {
    const double x = value(i);
    if (std::isnan(x)) continue;
    if (metric.worst < 0 || is_worse(x, worst)) {
      metric.worst = i;
      worst = x;
    }
    metric.min = std::min(metric.min, x);
    metric.max = std::max(metric.max, x);
    metric.mean += x;
    ++metric.count;
    if (is_worse(x, metric.threshold)) beyond.emplace_back(x, i);
  }
  if (metric.count == 0) {
    metric.min = metric.max = 0.0;
    return;
  }
  metric.mean /= static_cast<double>(metric.count);
  std::stable_sort(beyond.begin(), beyond.end(),
                   [&](const auto& a, const auto& b) { return is_worse(a.first, b.first); });
  for (const auto& [x, i] : beyond) {
    metric.beyond.push_back(i);
    metric.of_beyond.push_back(x);
  }
}

}  // namespace

Vec3 center_of_face(const FaceMesh& faces, const std::vector<Vec3>& points, int face) {
  Vec3 sum = Vec3::Zero();
  const auto vertices = faces.face(face);
  for (const int v : vertices) sum += points[v];
  return sum / static_cast<double>(vertices.size());
}

std::vector<FoamMetric> foam_metrics(const FaceMesh& faces, const std::vector<Vec3>& points) {
  const Measures m(faces, points);
  struct Definition {
    FoamMetric metric;
    std::function<double(int)> value;
  };
  const std::vector<Definition> definitions{
      {{"nonOrthoAngle", "nonOrthoFaces", true, false, 70.0},
       [&](int f) { return m.non_orthogonality(f); }},
      {{"skewness", "skewFaces", true, false, 4.0}, [&](int f) { return m.skewness(f); }},
      {{"faceWeight", "lowWeightFaces", true, true, 0.05}, [&](int f) { return m.weight(f); }},
      {{"cellVolumeRatio", "lowVolRatioFaces", true, true, 0.01},
       [&](int f) { return m.volume_ratio(f); }},
      {{"faceFlatness", "warpedFaces", true, true, 0.8}, [&](int f) { return m.flatness(f); }},
      {{"minPyrVolume", "wrongOrientedFaces", true, true, 0.0},
       [&](int f) { return m.pyramid(f); }},
      {{"faceTetVolume", "lowQualityTetFaces", true, true, 0.0},
       [&](int f) { return m.face_tets(f); }},
      {{"aspectRatio", "highAspectRatioCells", false, false, 1000.0},
       [&](int c) { return m.aspect_ratio(c); }},
      {{"cellOpenness", "nonClosedCells", false, false, 1e-6},
       [&](int c) { return m.openness(c); }},
      {{"cellDeterminant", "underdeterminedCells", false, true, 0.001},
       [&](int c) { return m.determinant(c); }},
      {{"cellVolume", "zeroVolumeCells", false, true, 1e-300}, [&](int c) { return m.volume(c); }},
  };
  std::vector<FoamMetric> metrics;
  metrics.reserve(definitions.size());
  for (const Definition& definition : definitions) {
    metrics.push_back(definition.metric);
    fill(metrics.back(), definition.metric.is_of_faces ? faces.size() : faces.cells,
         definition.value);
  }
  metrics.front().mean = m.mean_non_orthogonality();
  return metrics;
}

}  // namespace hexwall
