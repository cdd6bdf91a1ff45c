#pragma once

#include <array>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Corners of a quadrilateral face, in order around it.
using Face = std::array<Vec3, 4>;

struct FaceGeometry {
  Vec3 center;
  Vec3 area;  ///< vector, by the right hand
};

/// Centre and area of a face as OpenFOAM takes them: by the four triangles around the mean of the
/// corners, the centre weighted by their areas (primitiveMesh::makeFaceCentresAndAreas).
FaceGeometry face_geometry(const Face& face);

/// Centre of a hex as OpenFOAM takes it: by the pyramids of the faces over the mean of their
/// centres, weighted by their volumes (primitiveMesh::makeCellCentresAndVols).
/// \param corners in VTK's order.
Vec3 cell_center(const std::array<Vec3, 8>& corners);

/// Least height of `above` over, and of `below` under, the two triangles on either side of the
/// diagonal of `face` from corner `k`. Null where there is no such point.
double split_height(const Face& face, int k, const Vec3* below, const Vec3* above);

}  // namespace hexwall
