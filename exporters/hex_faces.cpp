#include "exporters/hex_faces.h"

#include <algorithm>
#include <string>

#include "core/errors.h"

namespace hexwall {
namespace {

constexpr std::array<int, 6> kNoFaces{-1, -1, -1, -1, -1, -1};

[[noreturn]] void inconsistent(const std::string& what) {
  throw Error(ExitCode::internal, "inconsistent hex mesh: " + what);
}

/// The same polygon read from its smallest vertex on: equal for equal oriented faces.
std::array<int, 4> from_smallest(std::array<int, 4> face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

bool is_same_face(const std::array<int, 4>& a, const std::array<int, 4>& b) {
  return from_smallest(a) == from_smallest(b);
}

bool is_reversed_face(const std::array<int, 4>& a, const std::array<int, 4>& b) {
  return is_same_face(a, {b[3], b[2], b[1], b[0]});
}

bool has_same_vertices(std::array<int, 4> a, std::array<int, 4> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

int hex_count(const HexMesh& mesh) {
  return static_cast<int>(mesh.hexes.size());
}

int local_face(const HexMesh& mesh, const BoundaryFace& face, const std::string& patch) {
  if (face.hex < 0 || face.hex >= hex_count(mesh))
    inconsistent("patch " + patch + " names hex " + std::to_string(face.hex));
  for (int i = 0; i < 6; ++i)
    if (is_same_face(hex_face(mesh, face.hex, i), face.vertices)) return i;
  inconsistent("patch " + patch + " lists a face that hex " + std::to_string(face.hex) +
               " does not have with this orientation");
}

/// The faces of all hexes as 6·hex + face, grouped by the smallest vertex.
struct FacesByVertex {
  std::vector<int> begin;  ///< #V+1 start of the vertex' group in `faces`
  std::vector<int> faces;  ///< #6H
};

int smallest_vertex(const HexMesh& mesh, int face_id) {
  const std::array<int, 4> face = hex_face(mesh, face_id / 6, face_id % 6);
  return *std::min_element(face.begin(), face.end());
}

void check_vertices(const HexMesh& mesh) {
  const int n = static_cast<int>(mesh.points.size());
  for (const auto& hex : mesh.hexes)
    for (const int v : hex)
      if (v < 0 || v >= n) inconsistent("vertex " + std::to_string(v) + " does not exist");
}

FacesByVertex group_faces(const HexMesh& mesh) {
  const int n = 6 * hex_count(mesh);
  FacesByVertex groups{std::vector<int>(mesh.points.size() + 1, 0), std::vector<int>(n)};
  for (int id = 0; id < n; ++id) ++groups.begin[smallest_vertex(mesh, id) + 1];
  for (std::size_t v = 1; v < groups.begin.size(); ++v) groups.begin[v] += groups.begin[v - 1];
  std::vector<int> next = groups.begin;
  for (int id = 0; id < n; ++id) groups.faces[next[smallest_vertex(mesh, id)]++] = id;
  return groups;
}

std::string two_hexes(int a, int b) {
  return "hexes " + std::to_string(a / 6) + " and " + std::to_string(b / 6);
}

void join(const HexMesh& mesh, int a, int b, HexFaceValues& neighbours) {
  int& of_a = neighbours[a / 6][a % 6];
  int& of_b = neighbours[b / 6][b % 6];
  if (of_a >= 0 || of_b >= 0) inconsistent(two_hexes(a, b) + " share a face with a third hex");
  if (!is_reversed_face(hex_face(mesh, a / 6, a % 6), hex_face(mesh, b / 6, b % 6)))
    inconsistent(two_hexes(a, b) + " lie on the same side of their common face");
  of_a = b / 6;
  of_b = a / 6;
}

void check_boundary(const HexFaceValues& neighbours, const HexFaceValues& patch_of) {
  for (std::size_t hex = 0; hex < neighbours.size(); ++hex)
    for (int i = 0; i < 6; ++i) {
      const bool on_boundary = neighbours[hex][i] < 0;
      if (on_boundary == (patch_of[hex][i] >= 0)) continue;
      inconsistent("face " + std::to_string(i) + " of hex " + std::to_string(hex) +
                   (on_boundary ? " is on the boundary but in no patch"
                                : " is in a patch but not on the boundary"));
    }
}

}  // namespace

std::array<int, 4> hex_face(const HexMesh& mesh, int hex, int face) {
  const auto& corners = kHexFaces[face];
  const auto& vertices = mesh.hexes[hex];
  return {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]], vertices[corners[3]]};
}

HexFaceValues patch_of_hex_faces(const HexMesh& mesh) {
  HexFaceValues patches(mesh.hexes.size(), kNoFaces);
  for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
    const std::string& name = mesh.patches[p].name;
    for (const BoundaryFace& face : mesh.patches[p].faces) {
      const int local = local_face(mesh, face, name);
      int& patch = patches[face.hex][local];
      if (patch >= 0) inconsistent("a face of patch " + name + " is listed twice");
      patch = static_cast<int>(p);
    }
  }
  return patches;
}

HexFaceValues neighbours_of_hexes(const HexMesh& mesh) {
  check_vertices(mesh);
  const FacesByVertex groups = group_faces(mesh);
  HexFaceValues neighbours(mesh.hexes.size(), kNoFaces);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (int i = groups.begin[v]; i < groups.begin[v + 1]; ++i)
      for (int j = i + 1; j < groups.begin[v + 1]; ++j) {
        const int a = groups.faces[i];
        const int b = groups.faces[j];
        if (has_same_vertices(hex_face(mesh, a / 6, a % 6), hex_face(mesh, b / 6, b % 6)))
          join(mesh, a, b, neighbours);
      }
  return neighbours;
}

std::vector<std::vector<HexFace>> faces_of_patches(const HexMesh& mesh,
                                                   const HexFaceValues& neighbours) {
  const HexFaceValues patch_of = patch_of_hex_faces(mesh);
  check_boundary(neighbours, patch_of);
  std::vector<std::vector<HexFace>> faces(mesh.patches.size());
  for (int hex = 0; hex < hex_count(mesh); ++hex)
    for (int i = 0; i < 6; ++i)
      if (const int patch = patch_of[hex][i]; patch >= 0) faces[patch].push_back({hex, i});
  return faces;
}

std::vector<HexFace> faces_of_zone(const HexMesh& mesh, const FaceZone& zone,
                                   const HexFaceValues& neighbours) {
  std::vector<HexFace> faces;
  faces.reserve(zone.faces.size());
  for (const BoundaryFace& face : zone.faces) {
    const int local = local_face(mesh, face, zone.name);
    if (neighbours[face.hex][local] < 0)
      inconsistent("a face of zone " + zone.name + " is on the boundary");
    faces.push_back({face.hex, local});
  }
  return faces;
}

std::vector<int> group_of_hexes(const HexMesh& mesh, const std::vector<CellZone>& groups) {
  std::vector<int> group_of(mesh.hexes.size(), -1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int hex : groups[g].hexes) {
      if (hex < 0 || hex >= hex_count(mesh) || group_of[hex] >= 0)
        inconsistent("zone " + groups[g].name + " lists hex " + std::to_string(hex) +
                     ", which does not exist or is in a zone already");
      group_of[hex] = static_cast<int>(g);
    }
  if (std::find(group_of.begin(), group_of.end(), -1) != group_of.end())
    inconsistent("a hex is in no zone");
  return group_of;
}

}  // namespace hexwall
