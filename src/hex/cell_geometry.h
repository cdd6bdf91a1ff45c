#pragma once

#include <array>
#include <span>

#include "surface/lanes.h"
#include "surface/triangle_surface.h"

namespace hexwall {

/// Corners of a quadrilateral face, in order around it.
using Face = std::array<Vec3, 4>;

struct FaceGeometry {
  Vec3 center;
  Vec3 area;  ///< vector, by the right hand
};

/// Centre and area of a face of three or more corners as OpenFOAM takes them: by the triangles
/// around the mean of the corners, the centre weighted by their areas
/// (primitiveMesh::makeFaceCentresAndAreas).
FaceGeometry face_geometry(std::span<const Vec3> face);

struct CellGeometry {
  Vec3 center;
  double volume;
};

/// Centre and volume of a cell as OpenFOAM takes them: by the pyramids of the faces over the mean
/// of their centres, the centre weighted by their volumes (primitiveMesh::makeCellCentresAndVols).
/// \param faces with areas pointing out.
CellGeometry cell_geometry(std::span<const FaceGeometry> faces);

/// Centre of a hex, see above. \param low, high corners of opposite faces, counter-clockwise seen
/// from above.
Vec3 cell_center(const VectorLanes& low, const VectorLanes& high);

/// The same. \param corners in VTK's order.
Vec3 cell_center(const std::array<Vec3, 8>& corners);

/// Skewness of a face between two cells, as OpenFOAM's checkMesh measures it: how far the line
/// between the cells' centres passes from the face's centre, relative to the face's extent in that
/// direction. \param geometry `face_geometry(face)`
double skewness_between(std::span<const Vec3> face, const FaceGeometry& geometry, const Vec3& owner,
                        const Vec3& neighbour);

/// The same of a face at the boundary, with the normal through the cell's centre.
double skewness_at_boundary(std::span<const Vec3> face, const FaceGeometry& geometry,
                            const Vec3& owner);

/// Least height of `above` over, and of `below` under, the triangles of a face that is split by the
/// better diagonal. Null where there is no such point.
double best_split_height(const VectorLanes& face, const Vec3* below, const Vec3* above);

}  // namespace hexwall
