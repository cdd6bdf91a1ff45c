#pragma once

#include <array>
#include <span>
#include <vector>

#include "hex/cell_mesh.h"

namespace hexwall {

/// Corners of the faces of a shape in VTK's order of them, the fourth -1 in a triangle. Each face
/// is counter-clockwise seen from outside a cell of positive volume.
std::span<const std::array<int, 4>> faces_of(CellShape shape);

/// One value per face of each cell, in the order of `faces_of`; -1 for faces that the shape does
/// not have. #C.
using CellFaceValues = std::vector<std::array<int, 6>>;

/// A face of a cell, by its place in `faces_of`.
struct LocalFace {
  int cell;
  int local;
};

/// Vertices of face `face` of a cell, seen from outside the cell, the fourth -1 in a triangle.
std::array<int, 4> cell_face(const CellMesh& mesh, int cell, int face);

/// Number of the corners of a face.
inline int corner_count(const std::array<int, 4>& face) {
  return face[3] < 0 ? 3 : 4;
}

/// Patch of each face of each cell: an index into `mesh.patches`, or -1.
/// \throw Error(ExitCode::internal) if a patch lists a face that its cell does not have, or has
/// with the opposite orientation, or if a face is listed twice.
CellFaceValues patch_of_faces(const CellMesh& mesh);

/// The cell on the other side of each face of each cell, or -1 where there is none. Cost
/// O(#C). \throw Error(ExitCode::internal) if a vertex index is out of range, if three cells
/// share a face, or if two cells that share a face lie on the same side of it.
CellFaceValues neighbours_of_cells(const CellMesh& mesh);

/// Faces of each patch, in the order of the cells. #patches.
/// \param neighbours `neighbours_of_cells(mesh)`
/// \throw Error(ExitCode::internal) unless the patches are a partition of the boundary faces.
std::vector<std::vector<LocalFace>> faces_of_patches(const CellMesh& mesh,
                                                     const CellFaceValues& neighbours);

/// Faces of a face zone, each as a face of the cell that the zone lists. \throw
/// Error(ExitCode::internal) if a cell does not have a face, or it is not between two cells.
std::vector<LocalFace> faces_of_zone(const CellMesh& mesh, const CellPatch& zone,
                                     const CellFaceValues& neighbours);

/// The group of each cell, of the zones or the regions of `mesh`: an index into `groups`. #C.
/// \throw Error(ExitCode::internal) unless the groups are a partition of the cells.
std::vector<int> group_of_cells(const CellMesh& mesh, const std::vector<CellGroup>& groups);

/// A face with the cells on both sides, as OpenFOAM numbers them.
struct SharedFace {
  std::array<int, 4> vertices;  ///< out of its owner
  int owner;
  int local;      ///< its place in the owner
  int neighbour;  ///< -1 on the boundary
};

/// Faces in OpenFOAM's order: the internal ones in upper-triangular order, then those of the
/// patches, in the order of the cells within a patch.
struct SharedFaces {
  std::vector<SharedFace> faces;
  int internal = 0;
};

/// \throw Error(ExitCode::internal) if the mesh does not conform, or the patches are no partition
/// of the boundary faces.
SharedFaces shared_faces(const CellMesh& mesh);

/// The cells of one of the regions as a mesh of its own, with those points, patches and zones that
/// it has. Faces of a face zone that border the region become a patch, `REGION_to_OTHER`, of type
/// wall, in the order of the face zone, so that both sides match face by face.
CellMesh region_mesh(const CellMesh& mesh, int region);

}  // namespace hexwall
