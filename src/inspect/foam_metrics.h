#pragma once

#include <string>
#include <vector>

#include "inspect/any_mesh.h"
#include "inspect/face_mesh.h"

namespace hexwall {

/// One of OpenFOAM's measures of a mesh, of its faces or its cells.
struct FoamMetric {
  std::string name;  ///< of the field that checkMesh -writeAllFields writes, where there is one
  std::string set;   ///< the set into which checkMesh writes those beyond the threshold
  bool is_of_faces = false;
  bool low_is_bad = false;
  double threshold = 0.0;  ///< of checkMesh
  double min = 0.0, max = 0.0, mean = 0.0;
  std::size_t count = 0;               ///< faces or cells that have the measure
  std::vector<int> beyond = {};        ///< faces or cells beyond the threshold, the worst first
  std::vector<double> of_beyond = {};  ///< their values
  int worst = -1;                      ///< the worst face or cell, beyond or not; -1: none
};

/// checkMesh's measures (OpenFOAM 1912, primitiveMeshCheck and polyMeshCheck): nonOrthoAngle,
/// skewness, faceWeight, cellVolumeRatio, faceFlatness, minPyrVolume, faceTetVolume; aspectRatio,
/// cellOpenness, cellDeterminant, cellVolume. Coupled patches count as boundary.
/// \param points of the cells.
std::vector<FoamMetric> foam_metrics(const FaceMesh& faces, const std::vector<Vec3>& points);

/// Mean of the vertices of a face.
Vec3 center_of_face(const FaceMesh& faces, const std::vector<Vec3>& points, int face);

}  // namespace hexwall
