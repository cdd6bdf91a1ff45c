#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "inspect/any_mesh.h"

namespace hexwall {

/// The cells of a mesh with their faces.
struct CellFaces {
  FaceMesh faces;
  std::vector<int> element;  ///< #cells: the element of `AnyMesh`
  int overfull = 0;          ///< faces of more than two cells; those beyond count as boundary
};

/// Faces with equal vertices are one, between two cells; all others are the boundary. Where the
/// file lists faces, those are taken. Cost O(n log n).
CellFaces cell_faces(const AnyMesh& mesh);

/// Calls visit(face) for each face of a polyhedron's stream: number of faces, then for each the
/// number of its vertices and these. \returns false if the stream does not end with the last face.
template <typename Visit>
bool for_faces_of_stream(std::span<const int> stream, const Visit& visit) {
  if (stream.empty()) return false;
  std::size_t at = 1;
  for (int f = 0; f < stream[0]; ++f) {
    if (at >= stream.size() || stream[at] < 3) return false;
    const auto n = static_cast<std::size_t>(stream[at]);
    if (n > stream.size() - at - 1) return false;
    visit(stream.subspan(at + 1, n));
    at += n + 1;
  }
  return at == stream.size();
}

/// The vertices of a polyhedron, each once, ascending. \throws ReadError if the stream is damaged.
std::vector<int> vertices_of_stream(std::span<const int> stream, std::int64_t label);

/// Adds `offset` to the vertices of a face stream; does nothing to one that is damaged.
void offset_stream(std::vector<int>& stream, int offset);

}  // namespace hexwall
