#include "surface/transfer.h"

#include <array>
#include <unordered_map>

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include "surface/point_bits.h"
#include "surface/projector.h"

namespace hexwall {
namespace {

/// Finds the triangle nearest to a point, among those that have area.
class NearestTriangle {
 public:
  explicit NearestTriangle(const TriangleSurface& surface) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : surface.points) points->InsertNextPoint(p.data());
    vtkNew<vtkCellArray> cells;
    for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
      const auto& [a, b, c] = surface.triangles[f];
      if (doubled_area_vector(surface, f).norm() == 0.0) continue;
      const std::array<vtkIdType, 3> corners{a, b, c};
      cells->InsertNextCell(3, corners.data());
      triangle_.push_back(f);
    }
    data_->SetPoints(points);
    data_->SetPolys(cells);
    locator_->SetDataSet(data_);
    locator_->BuildLocator();
  }

  SurfacePoint operator()(const Vec3& p) const {
    SurfacePoint nearest;
    vtkIdType cell = -1;
    int part = 0;
    double squared = 0.0;
    locator_->FindClosestPoint(p.data(), nearest.position.data(), cell_, cell, part, squared);
    nearest.face = triangle_[cell];
    return nearest;
  }

 private:
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
  std::vector<int> triangle_;  // of each cell
};

std::unordered_map<PointBits, int, PointBitsHash> vertices_by_place(
    const TriangleSurface& surface) {
  std::unordered_map<PointBits, int, PointBitsHash> result;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    result.try_emplace(bits_of(surface.points[v]), static_cast<int>(v));
  }
  return result;
}

// In a needle the weights are noise as large as it is thin: within [0, 1] they still interpolate.
Vec3 weights_at(const TriangleSurface& surface, const SurfacePoint& point) {
  const Vec3 weights = barycentric_coordinates(surface, point).cwiseMax(0.0).cwiseMin(1.0);
  return weights / weights.sum();
}

}  // namespace

std::vector<double> transfer_point_array(const SurfaceArray& array, const TriangleSurface& from,
                                         const TriangleSurface& to) {
  const auto vertices = vertices_by_place(from);
  const NearestTriangle nearest_triangle(from);
  const auto value = [&](int v, int k) { return array.values[v * array.components + k]; };
  std::vector<double> result;
  result.reserve(to.points.size() * array.components);
  for (const Vec3& p : to.points) {
    if (const auto same = vertices.find(bits_of(p)); same != vertices.end()) {
      for (int k = 0; k < array.components; ++k) result.push_back(value(same->second, k));
      continue;
    }
    const SurfacePoint nearest = nearest_triangle(p);
    const auto& [a, b, c] = from.triangles[nearest.face];
    const Vec3 w = weights_at(from, nearest);
    for (int k = 0; k < array.components; ++k) {
      result.push_back(w[0] * value(a, k) + w[1] * value(b, k) + w[2] * value(c, k));
    }
  }
  return result;
}

}  // namespace hexwall
