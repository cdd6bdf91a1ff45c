#include "inspect/cell_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <vtkHexahedron.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkQuad.h>
#include <vtkTetra.h>
#include <vtkTriangle.h>

namespace hexwall {
namespace {

enum Metric {
  scaled_jacobian,
  edge_ratio,
  aspect_ratio,
  aspect_frobenius,
  skew,
  min_angle,
  max_angle,
  volume,
  area,
  metric_count
};

constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Values = std::array<double, metric_count>;
using Verdict = double (*)(vtkCell*);

/// What Verdict has for a shape; null where it has nothing. Its edge ratio of hexahedra depends on
/// the order of the corners, so that edges are measured here.
struct VerdictMetrics {
  Verdict scaled_jacobian, aspect_ratio, aspect_frobenius, skew, volume, area;
};

using Q = vtkMeshQuality;
constexpr VerdictMetrics of_triangle{Q::TriangleScaledJacobian,
                                     Q::TriangleAspectRatio,
                                     Q::TriangleAspectFrobenius,
                                     nullptr,
                                     nullptr,
                                     Q::TriangleArea};
constexpr VerdictMetrics of_quad{Q::QuadScaledJacobian,
                                 Q::QuadAspectRatio,
                                 Q::QuadMaxAspectFrobenius,
                                 Q::QuadSkew,
                                 nullptr,
                                 Q::QuadArea};
constexpr VerdictMetrics of_tetrahedron{
    Q::TetScaledJacobian, Q::TetAspectRatio, Q::TetAspectFrobenius, nullptr, Q::TetVolume, nullptr};
constexpr VerdictMetrics of_hexahedron{Q::HexScaledJacobian, nullptr,      Q::HexMaxAspectFrobenius,
                                       Q::HexSkew,           Q::HexVolume, nullptr};

/// VTK's cells, filled anew for each element.
class VerdictCells {
 public:
  void measure(const AnyMesh& mesh, int element, Values& values) {
    switch (mesh.shape[element]) {
      case ElementShape::triangle:
        return measure(mesh, element, triangle_, of_triangle, values);
      case ElementShape::quad:
        return measure(mesh, element, quad_, of_quad, values);
      case ElementShape::tetrahedron:
        return measure(mesh, element, tetrahedron_, of_tetrahedron, values);
      case ElementShape::hexahedron:
        return measure(mesh, element, hexahedron_, of_hexahedron, values);
      default:
        return;
    }
  }

 private:
  static void measure(const AnyMesh& mesh, int element, vtkCell* cell,
                      const VerdictMetrics& metrics, Values& values) {
    const auto corners = mesh.element(element);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      cell->Points->SetPoint(static_cast<vtkIdType>(k), mesh.points[corners[k]].data());
    }
    const auto set = [&](Metric metric, Verdict verdict) {
      if (verdict != nullptr) values[metric] = verdict(cell);
    };
    set(scaled_jacobian, metrics.scaled_jacobian);
    // Verdict says 1e30 where an edge has no length.
    if (values[scaled_jacobian] > 1.0 + 1e-6) values[scaled_jacobian] = 0.0;
    set(aspect_ratio, metrics.aspect_ratio);
    set(aspect_frobenius, metrics.aspect_frobenius);
    set(skew, metrics.skew);
    set(volume, metrics.volume);
    set(area, metrics.area);
  }

  vtkNew<vtkTriangle> triangle_;
  vtkNew<vtkQuad> quad_;
  vtkNew<vtkTetra> tetrahedron_;
  vtkNew<vtkHexahedron> hexahedron_;
};

// Triple product of the unit edges that leave a corner.
double corner_jacobian(const AnyMesh& mesh, std::span<const int> corners,
                       const std::array<int, 4>& ends) {
  const Vec3& p = mesh.points[corners[ends[0]]];
  const Vec3 u = mesh.points[corners[ends[1]]] - p;
  const Vec3 v = mesh.points[corners[ends[2]]] - p;
  const Vec3 w = mesh.points[corners[ends[3]]] - p;
  const double scale = u.norm() * v.norm() * w.norm();
  return scale > 0.0 ? u.cross(v).dot(w) / scale : 0.0;
}

// A corner and its neighbours, in an order of positive orientation.
constexpr std::array<std::array<int, 4>, 6> wedge_corners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<std::array<int, 4>, 4> pyramid_corners{
    {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};

double least_corner_jacobian(const AnyMesh& mesh, int element,
                             std::span<const std::array<int, 4>> corners, double of_ideal) {
  double least = std::numeric_limits<double>::max();
  for (const auto& corner : corners) {
    least = std::min(least, corner_jacobian(mesh, mesh.element(element), corner) / of_ideal);
  }
  return std::min(least, 1.0);
}

// Calls visit(a, b, c) at each corner b of each face of an element; triangles, quads and polygons
// are their own face.
template <typename Visit>
void for_corners(const AnyMesh& mesh, int element, const Visit& visit) {
  const auto corners = mesh.element(element);
  const auto at = [&](int k) -> const Vec3& { return mesh.points[corners[k]]; };
  if (!is_volume(mesh.shape[element])) {
    const auto n = static_cast<int>(corners.size());
    for (int k = 0; k < n; ++k) visit(at((k + n - 1) % n), at(k), at((k + 1) % n));
    return;
  }
  for (const ShapeFace& face : faces_of(mesh.shape[element])) {
    const int n = face[3] < 0 ? 3 : 4;
    for (int k = 0; k < n; ++k) {
      visit(at(face[(k + n - 1) % n]), at(face[k]), at(face[(k + 1) % n]));
    }
  }
}

double angle_deg(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - b;
  const Vec3 v = c - b;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi;
}

void measure_angles_and_edges(const AnyMesh& mesh, int element, Values& values) {
  double least_angle = std::numeric_limits<double>::max();
  double greatest_angle = -1.0;
  double shortest = std::numeric_limits<double>::max();
  double longest = 0.0;
  for_corners(mesh, element, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double angle = angle_deg(a, b, c);
    least_angle = std::min(least_angle, angle);
    greatest_angle = std::max(greatest_angle, angle);
    const double length = (c - b).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  });
  if (greatest_angle < 0.0) return;
  values[min_angle] = least_angle;
  values[max_angle] = greatest_angle;
  values[edge_ratio] = shortest > 0.0 ? longest / shortest : std::numeric_limits<double>::max();
}

void measure_own(const AnyMesh& mesh, int element, Values& values) {
  measure_angles_and_edges(mesh, element, values);
  const ElementShape shape = mesh.shape[element];
  if (shape == ElementShape::wedge) {
    const double of_ideal = std::sqrt(3.0) / 2.0;  // equilateral triangles, right angles upwards
    values[scaled_jacobian] = least_corner_jacobian(mesh, element, wedge_corners, of_ideal);
    values[volume] = volume_of(mesh, element);
  } else if (shape == ElementShape::pyramid) {
    const double of_ideal = std::sqrt(0.5);  // all eight edges are equal
    values[scaled_jacobian] = least_corner_jacobian(mesh, element, pyramid_corners, of_ideal);
    values[volume] = volume_of(mesh, element);
  } else if (shape == ElementShape::polygon) {
    Vec3 doubled = Vec3::Zero();
    const Vec3 center = center_of(mesh, element);
    for_corners(mesh, element, [&](const Vec3&, const Vec3& b, const Vec3& c) {
      doubled += (b - center).cross(c - center);
    });
    values[area] = 0.5 * doubled.norm();
  }
}

}  // namespace

const std::vector<CellMetric>& cell_metrics() {
  static const std::vector<CellMetric> metrics{
      {"scaled_jacobian", "", true, {0.0, 1.0, 20}},
      {"edge_ratio", "", false, {}},
      {"aspect_ratio", "", false, {}},
      {"aspect_frobenius", "", false, {}},
      {"skew", "", false, {0.0, 1.0, 20}},
      {"min_angle", "deg", true, {0.0, 90.0, 18}},
      {"max_angle", "deg", false, {60.0, 180.0, 24}},
      {"volume", "length^3", true, {}},
      {"area", "length^2", true, {}},
  };
  return metrics;
}

std::vector<MetricValues> measure_cells(const AnyMesh& mesh, const std::vector<int>& elements) {
  std::vector<MetricValues> result(metric_count, MetricValues(elements.size(), none));
  VerdictCells verdict;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    Values values;
    values.fill(none);
    measure_own(mesh, elements[i], values);
    verdict.measure(mesh, elements[i], values);
    for (int m = 0; m < metric_count; ++m) result[m][i] = values[m];
  }
  return result;
}

CornerValues measure_corners(const AnyMesh& mesh, const std::vector<int>& elements) {
  CornerValues values;
  for (const int e : elements) {
    for_corners(mesh, e, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      values.angle.push_back(angle_deg(a, b, c));
      const double before = (b - a).norm();
      const double after = (c - b).norm();
      if (before > 0.0 && after > 0.0) values.log_edge_ratio.push_back(std::log(after / before));
    });
  }
  return values;
}

Bins log_ratio_bins(const std::vector<double>& values) {
  constexpr double widest = 8.0;
  double greatest = 1.0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  const double end = std::min(std::ceil(greatest), widest);
  return {-end, end, 40};
}

}  // namespace hexwall
