#include "lumen/cell_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "core/parallel.h"

namespace hexwall {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double reported_angle = 70.0;

double aspect_ratio(const CellMesh& mesh, int cell, double volume) {
  Vec3 extent = Vec3::Zero();
  const auto count = static_cast<int>(faces_of(mesh.shape[cell]).size());
  for (int i = 0; i < count; ++i) {
    extent +=
        face_geometry(FacePoints(mesh.points, cell_face(mesh, cell, i)).span()).area.cwiseAbs();
  }
  const double by_extent = extent.maxCoeff() / extent.minCoeff();
  return std::max(by_extent, extent.sum() / 6.0 / std::pow(volume, 2.0 / 3.0));
}

CellGeometry geometry_of(const CellMesh& mesh, int cell) {
  std::array<FaceGeometry, 6> faces;
  const std::size_t count = faces_of(mesh.shape[cell]).size();
  for (std::size_t i = 0; i < count; ++i) {
    faces[i] =
        face_geometry(FacePoints(mesh.points, cell_face(mesh, cell, static_cast<int>(i))).span());
  }
  return cell_geometry(std::span(faces).first(count));
}

void judge_cells(const CellMesh& mesh, const std::vector<CellGeometry>& cells, CellQuality& q) {
  q.least_volume = std::numeric_limits<double>::max();
  for (int c = 0; c < mesh.cells(); ++c) {
    q.least_volume = std::min(q.least_volume, cells[c].volume);
    q.volume += cells[c].volume;
    q.aspect_ratio.raise(aspect_ratio(mesh, c, cells[c].volume), cells[c].center);
  }
}

}  // namespace

FacePoints::FacePoints(const std::vector<Vec3>& points, const std::array<int, 4>& face)
    : count(static_cast<std::size_t>(corner_count(face))) {
  for (std::size_t k = 0; k < count; ++k) corners[k] = points[face[k]];
}

std::vector<CellGeometry> cell_geometries(const CellMesh& mesh) {
  std::vector<CellGeometry> cells(mesh.shape.size());
  parallel_for(cells.size(),
               [&](std::size_t c) { cells[c] = geometry_of(mesh, static_cast<int>(c)); });
  return cells;
}

double mean_wall_distance(const CellMesh& mesh) {
  double sum = 0.0;
  double area = 0.0;
  for (const CellPatch& patch : mesh.patches) {
    if (!patch.is_wall) continue;
    for (const CellFace& face : patch.faces) {
      const FaceGeometry geometry = face_geometry(FacePoints(mesh.points, face.vertices).span());
      sum += geometry.area.dot(geometry.center - geometry_of(mesh, face.cell).center);
      area += geometry.area.norm();
    }
  }
  return area > 0.0 ? sum / area : 0.0;
}

CellQuality cell_quality(const CellMesh& mesh) {
  CellQuality q;
  const std::vector<CellGeometry> cells = cell_geometries(mesh);
  judge_cells(mesh, cells, q);
  const SharedFaces faces = shared_faces(mesh);
  double cosines = 0.0;
  for (const SharedFace& face : faces.faces) {
    const FacePoints points(mesh.points, face.vertices);
    const FaceGeometry geometry = face_geometry(points.span());
    const CellGeometry& owner = cells[face.owner];
    if (face.neighbour < 0) {
      q.skewness.raise(skewness_at_boundary(points.span(), geometry, owner.center),
                       geometry.center);
      continue;
    }
    const CellGeometry& other = cells[face.neighbour];
    const Vec3 d = other.center - owner.center;
    const double cosine =
        std::clamp(d.dot(geometry.area) / (d.norm() * geometry.area.norm()), -1.0, 1.0);
    const double angle = degrees * std::acos(cosine);
    cosines += cosine;
    if (angle > reported_angle) ++q.faces_above_70;
    q.non_orthogonality.raise(angle, geometry.center);
    q.skewness.raise(skewness_between(points.span(), geometry, owner.center, other.center),
                     geometry.center);
    const auto [less, more] = std::minmax(owner.volume, other.volume);
    q.volume_ratio.raise(more / less, geometry.center);
  }
  if (faces.internal > 0) {
    q.mean_non_orthogonality = degrees * std::acos(std::clamp(cosines / faces.internal, -1.0, 1.0));
  }
  return q;
}

}  // namespace hexwall
