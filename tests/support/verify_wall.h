#pragma once

#include "hex/hex_mesh.h"
#include "pipeline.h"
#include "support/mesh_verifier.h"

namespace hexwall::test {

/// Corners of the hexes, and of the faces of each patch, as `verify_hexes` takes them.
Hexes hexes_of(const HexMesh& mesh);
std::vector<Quads> faces_of_patches(const HexMesh& mesh);

/// `verify_hexes` on a mesh of the pipeline's.
HexVerdict verify_wall(const HexMesh& mesh);

/// Expects all that holds for every wall: valid hexes that fill their boundary, every quad with all
/// its layers, patches and zones that are what they are called, numbers as reported.
void expect_valid_wall(const PipelineResult& result);

/// Expects that the boundary of the whole mesh (skins and end rings) nowhere meets itself,
/// whichever way its faces are split into triangles.
void expect_no_self_intersection(const HexMesh& mesh);

}  // namespace hexwall::test
