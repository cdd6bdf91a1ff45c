#pragma once

#include <span>

#include "hex/cell_geometry.h"

namespace hexwall {

/// What is minimised to improve a mesh for OpenFOAM. Costs of faces and cells are about 1 at the
/// limits of checkMesh, and grow steeply from there.
namespace cost {

/// Of what is not valid: a cell that lies on the wrong side of its face.
inline constexpr double invalid = 1e30;

/// Faces and cells above this are worked on.
inline constexpr double wanted = 0.25;

/// Of a face between two cells: by non-orthogonality, skewness, interpolation weight, the ratio of
/// the volumes, and whether a quad can be split into face tets. \param geometry
/// `face_geometry(face)`, pointing from `owner` to `other`.
double of_face(std::span<const Vec3> face, const FaceGeometry& geometry, const CellGeometry& owner,
               const CellGeometry& other);

/// Of a face at the boundary, by its skewness.
double of_boundary_face(std::span<const Vec3> face, const FaceGeometry& geometry,
                        const CellGeometry& owner);

/// Of a cell, by the determinant of its internal faces (primitiveMeshTools::cellDeterminant), which
/// is small for flat cells. \param areas of the internal faces; the sign does not matter.
double of_cell(std::span<const Vec3> areas);

/// Of a cell that may be concave, by how far the centres of its faces lie inside the planes of the
/// others (primitiveMesh::checkConcaveCells). \param faces all, with areas pointing out.
double of_depth(std::span<const FaceGeometry> faces);

}  // namespace cost
}  // namespace hexwall
