#include "support/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

namespace hexwall::test {

struct SurfaceDistance::Locator {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkStaticCellLocator> tree;
  vtkNew<vtkGenericCell> cell;
};

SurfaceDistance::SurfaceDistance(const TriangleSurface& surface)
    : locator_(std::make_unique<Locator>()) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : surface.triangles) {
    const std::array<vtkIdType, 3> ids{triangle[0], triangle[1], triangle[2]};
    cells->InsertNextCell(3, ids.data());
  }
  locator_->data->SetPoints(points);
  locator_->data->SetPolys(cells);
  locator_->tree->SetDataSet(locator_->data);
  locator_->tree->BuildLocator();
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::Nearest SurfaceDistance::operator()(const Vec3& p) const {
  Vec3 nearest;
  vtkIdType cell = -1;
  int part = 0;
  double squared = 0.0;
  locator_->tree->FindClosestPoint(p.data(), nearest.data(), locator_->cell, cell, part, squared);
  return {(nearest - p).norm(), static_cast<int>(cell)};
}

double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& polyline) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polyline.size(); ++i) {
    const Vec3& a = polyline[i];
    const Vec3 along = polyline[(i + 1) % polyline.size()] - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * along - p).norm());
  }
  return least;
}

}  // namespace hexwall::test
