#pragma once

#include <string>
#include <vector>

#include "hex/cell_faces.h"
#include "hex/cell_geometry.h"
#include "hex/cell_mesh.h"

namespace hexwall {

/// A measure of the worst face or cell, and where that is.
struct Worst {
  double value = 0.0;
  Vec3 at = Vec3::Zero();

  void raise(double candidate, const Vec3& place) {
    if (candidate <= value) return;
    value = candidate;
    at = place;
  }
};

/// The quality of a mesh by the definitions of OpenFOAM's checkMesh.
struct CellQuality {
  Worst non_orthogonality;              ///< degrees between a face's normal and the centres' line
  double mean_non_orthogonality = 0.0;  ///< of the mean cosine, as checkMesh reports it
  int faces_above_70 = 0;               ///< degrees of non-orthogonality
  Worst skewness;
  Worst aspect_ratio;
  Worst volume_ratio;  ///< of neighbouring cells, the larger by the smaller
  double least_volume = 0.0;
  double volume = 0.0;
};

/// \pre a conforming mesh. \throws Error(ExitCode::internal) if it is not.
CellQuality cell_quality(const CellMesh& mesh);

/// Mean distance of the centres of the cells at patches of type wall from the planes of their wall
/// faces, weighted by the faces' areas. 0 without walls.
double mean_wall_distance(const CellMesh& mesh);

/// Geometry of each cell. #C.
std::vector<CellGeometry> cell_geometries(const CellMesh& mesh);

/// Corners of a face: four, the last of no meaning in a triangle.
struct FacePoints {
  std::array<Vec3, 4> corners;
  std::size_t count;

  FacePoints(const std::vector<Vec3>& points, const std::array<int, 4>& face);
  std::span<const Vec3> span() const { return {corners.data(), count}; }
};

}  // namespace hexwall
