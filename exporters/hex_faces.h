#pragma once

#include <array>
#include <vector>

#include "hex/hex_mesh.h"

namespace hexwall {

/// Corners of the six faces of a hexahedron in the order of VTK_HEXAHEDRON. Each face is
/// counter-clockwise seen from outside a hexahedron of positive volume.
inline constexpr std::array<std::array<int, 4>, 6> kHexFaces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// One value per face of each hex, in the order of `kHexFaces`. #H.
using HexFaceValues = std::vector<std::array<int, 6>>;

/// A face of a hex, by its place in `kHexFaces`.
struct HexFace {
  int hex;
  int local;
};

/// Vertices of face `face` of hex `hex`, seen from outside the hex.
std::array<int, 4> hex_face(const HexMesh& mesh, int hex, int face);

/// Patch of each face of each hex: an index into `mesh.patches`, or -1.
/// \throw Error(ExitCode::internal) if a patch lists a face that its hex does not have, or has with
/// the opposite orientation, or if a face is listed twice.
HexFaceValues patch_of_hex_faces(const HexMesh& mesh);

/// The hex on the other side of each face of each hex, or -1 where there is none. Cost O(#H).
/// \throw Error(ExitCode::internal) if a vertex index is out of range, if three hexes share a face,
/// or if two hexes that share a face lie on the same side of it.
HexFaceValues neighbours_of_hexes(const HexMesh& mesh);

/// Faces of each patch, in the order of the hexes. #patches.
/// \param neighbours `neighbours_of_hexes(mesh)`
/// \throw Error(ExitCode::internal) unless the patches are a partition of the boundary faces.
std::vector<std::vector<HexFace>> faces_of_patches(const HexMesh& mesh,
                                                   const HexFaceValues& neighbours);

/// Faces of a face zone, each as a face of the hex that the zone lists. \throw
/// Error(ExitCode::internal) if a hex does not have a face, or it is not between two hexes.
std::vector<HexFace> faces_of_zone(const HexMesh& mesh, const FaceZone& zone,
                                   const HexFaceValues& neighbours);

/// The group of each hex, of the zones or the regions of `mesh`: an index into `groups`. #H.
/// \throw Error(ExitCode::internal) unless the groups are a partition of the hexes.
std::vector<int> group_of_hexes(const HexMesh& mesh, const std::vector<CellZone>& groups);

}  // namespace hexwall
