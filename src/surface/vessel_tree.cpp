#include "surface/vessel_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include "core/cancel.h"
#include "core/errors.h"
#include "surface/vessel_field.h"
#include "surface/vessel_remesh.h"

namespace hexwall {
namespace {

constexpr int block_size = 8;  // grid cells per block that is skipped in one piece

// Samples nearer to zero than this fraction of the spacing would make triangles without area.
constexpr double zero_margin = 1e-3;

// A vertex this near to a cut, in spacings, moves into its plane instead of leaving a sliver.
constexpr double snap_distance = 0.25;

/// A regular grid of samples of the field, x fastest.
struct Grid {
  Vec3 origin;
  double spacing;
  std::array<int, 3> size;  ///< samples in each direction

  Vec3 point(int i, int j, int k) const { return origin + spacing * Vec3(i, j, k); }
};

Grid grid_around(const VesselField& field) {
  Grid grid{Vec3::Zero(), 0.5 * field.smallest_radius(), {}};
  grid.origin = field.bounds().min() - 2.0 * grid.spacing * Vec3::Ones();
  const Vec3 extent = field.bounds().max() - grid.origin;
  for (int k = 0; k < 3; ++k) {
    grid.size[k] = static_cast<int>(std::ceil(extent[k] / grid.spacing)) + 3;
  }
  return grid;
}

float sample(const VesselField& field, const Vec3& x, double margin) {
  const double value = field(x).value;
  return static_cast<float>(value < 0.0 ? std::min(value, -margin) : std::max(value, margin));
}

/// Fills one block; far from the surface, where the Lipschitz constant 1 rules out a change of
/// sign, with a single value.
void sample_block(const VesselField& field, const Grid& grid, const std::array<int, 3>& low,
                  float* values) {
  std::array<int, 3> high{};
  for (int k = 0; k < 3; ++k) high[k] = std::min(low[k] + block_size, grid.size[k]);
  const Vec3 first = grid.point(low[0], low[1], low[2]);
  const Vec3 last = grid.point(high[0], high[1], high[2]);
  const double at_center = field(0.5 * (first + last)).value;
  const bool is_far = std::abs(at_center) > 0.5 * (last - first).norm() + grid.spacing;
  for (int k = low[2]; k < high[2]; ++k) {
    for (int j = low[1]; j < high[1]; ++j) {
      float* row = values + (static_cast<std::ptrdiff_t>(k) * grid.size[1] + j) * grid.size[0];
      for (int i = low[0]; i < high[0]; ++i) {
        row[i] = is_far ? static_cast<float>(at_center)
                        : sample(field, grid.point(i, j, k), zero_margin * grid.spacing);
      }
    }
  }
}

vtkSmartPointer<vtkImageData> sample_field(const VesselField& field, const Grid& grid) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.size.data());
  image->SetSpacing(grid.spacing, grid.spacing, grid.spacing);
  image->SetOrigin(grid.origin.data());
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  for (int k = 0; k < grid.size[2]; k += block_size) {
    for (int j = 0; j < grid.size[1]; j += block_size) {
      for (int i = 0; i < grid.size[0]; i += block_size) {
        throw_if_cancelled();
        sample_block(field, grid, {i, j, k}, values);
      }
    }
  }
  return image;
}

TriangleSurface surface_of(vtkPolyData* data) {
  TriangleSurface surface;
  surface.points.resize(data->GetNumberOfPoints());
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    data->GetPoint(static_cast<vtkIdType>(v), surface.points[v].data());
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType f = 0; f < data->GetNumberOfCells(); ++f) {
    data->GetCellPoints(f, ids);
    // VTK winds triangles for values that are larger inside; here they are smaller.
    surface.triangles.push_back({static_cast<int>(ids->GetId(0)), static_cast<int>(ids->GetId(2)),
                                 static_cast<int>(ids->GetId(1))});
  }
  return surface;
}

TriangleSurface march(const VesselField& field, const Grid& grid) {
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(sample_field(field, grid));
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return surface_of(contour->GetOutput());
}

/// Cuts a surface open along one plane, near one open end only.
class Cut {
 public:
  Cut(TriangleSurface& surface, const OpenEnd& end, double spacing) : surface_(surface) {
    height_.resize(surface.points.size());
    for (std::size_t v = 0; v < height_.size(); ++v) {
      Vec3& p = surface.points[v];
      const Vec3 offset = p - end.center;
      height_[v] = offset.norm() < 3.0 * end.radius ? offset.dot(end.direction) : -spacing;
      if (std::abs(height_[v]) < snap_distance * spacing) {
        p -= height_[v] * end.direction;
        height_[v] = 0.0;
      }
    }
  }

  void apply() {
    std::vector<std::array<int, 3>> kept;
    for (const auto& t : surface_.triangles) {
      const auto [low, high] = std::minmax({height_[t[0]], height_[t[1]], height_[t[2]]});
      if (low >= 0.0) continue;
      if (high <= 0.0) {
        kept.push_back(t);
      } else {
        keep_lower_part(t, kept);
      }
    }
    surface_.triangles = std::move(kept);
  }

 private:
  void keep_lower_part(const std::array<int, 3>& t, std::vector<std::array<int, 3>>& kept) {
    std::vector<int> polygon;
    for (int k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      if (height_[a] <= 0.0) polygon.push_back(a);
      if (height_[a] * height_[b] < 0.0)
        polygon.push_back(crossing(std::min(a, b), std::max(a, b)));
    }
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      kept.push_back({polygon[0], polygon[i], polygon[i + 1]});
    }
  }

  int crossing(int a, int b) {
    const auto [it, is_new] = crossings_.try_emplace({a, b}, static_cast<int>(height_.size()));
    if (is_new) {
      const double t = height_[a] / (height_[a] - height_[b]);
      const Vec3 point = (1.0 - t) * surface_.points[a] + t * surface_.points[b];
      surface_.points.push_back(point);
      height_.push_back(0.0);
    }
    return it->second;
  }

  TriangleSurface& surface_;
  std::vector<double> height_;  ///< over the plane; negative is kept
  std::map<std::pair<int, int>, int> crossings_;
};

void drop_unused_points(TriangleSurface& surface) {
  std::vector<int> number(surface.points.size(), -1);
  std::vector<Vec3> points;
  for (auto& t : surface.triangles) {
    for (int& v : t) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(points.size());
        points.push_back(surface.points[v]);
      }
      v = number[v];
    }
  }
  surface.points = std::move(points);
}

}  // namespace

TriangleSurface vessel_tree(const std::vector<Branch>& branches, double edge) {
  const VesselField field(branches);
  if (edge > field.smallest_radius()) {
    throw UsageError(
        fmt::format("an edge length of {} is too long for this shape: use at most {:.3g}, "
                    "the radius of its thinnest branch",
                    edge, field.smallest_radius()));
  }
  const Grid grid = grid_around(field);
  TriangleSurface surface = march(field, grid);
  for (const OpenEnd& end : field.ends()) Cut(surface, end, grid.spacing).apply();
  drop_unused_points(surface);
  return remesh_on_field(surface, field, edge);
}

}  // namespace hexwall
