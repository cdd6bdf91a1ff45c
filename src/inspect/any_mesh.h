#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Shapes of elements. Corners are in VTK's order; elements of higher order count by their corners.
enum class ElementShape : unsigned char {
  triangle,
  quad,
  polygon,  ///< five corners or more
  tetrahedron,
  pyramid,
  wedge,
  hexahedron,
  polyhedron
};

inline constexpr int element_shapes = 8;

/// "triangle", "quad", …
std::string_view name(ElementShape shape);

bool is_volume(ElementShape shape);

/// Corners of a shape; 0 if that depends on the element.
int corner_count(ElementShape shape);

/// A face of a shape: positions of its corners, counter-clockwise from outside, -1 behind the
/// third in a triangle.
using ShapeFace = std::array<int, 4>;

/// Faces of a tetrahedron, pyramid, wedge or hexahedron.
std::span<const ShapeFace> faces_of(ElementShape shape);

/// The faces of a mesh of cells, each once.
struct FaceMesh {
  std::vector<int> vertices;   ///< of all faces, one after the other, pointing out of the owner
  std::vector<int> first{0};   ///< #faces + 1: where the vertices of each begin
  std::vector<int> owner;      ///< #faces
  std::vector<int> neighbour;  ///< #faces, -1 at the boundary
  int cells = 0;

  int size() const { return static_cast<int>(owner.size()); }
  std::span<const int> face(int f) const {
    return {vertices.data() + first[f], vertices.data() + first[f + 1]};
  }
  void add(std::span<const int> face, int own, int next);
};

/// A mesh as any tool may write it: surface elements, cells, or both.
struct AnyMesh {
  std::vector<Vec3> points;
  std::vector<ElementShape> shape;  ///< #E
  std::vector<int> corners;         ///< of all elements; of a polyhedron its vertices, each once
  std::vector<int> first{0};        ///< #E + 1
  std::vector<std::int64_t> label;  ///< #E: its number in the file
  std::string label_word = "cell";  ///< what the file calls what `label` counts
  /// Faces of the cells where the file lists them: elements 0 … cells - 1 are the cells then.
  std::optional<FaceMesh> faces;
  std::map<int, std::vector<int>> polyhedron_faces;  ///< of a polyhedron, without `faces`: its face
                                                     ///< stream, see face_mesh.h
  std::vector<std::string> notes;  ///< what was converted or left out, one sentence each

  int size() const { return static_cast<int>(shape.size()); }
  std::span<const int> element(int e) const {
    return {corners.data() + first[e], corners.data() + first[e + 1]};
  }
  void add(ElementShape kind, std::span<const int> vertices, std::int64_t number);
};

/// Mean of the corners of an element.
Vec3 center_of(const AnyMesh& mesh, int element);

/// Signed volume of a tetrahedron, pyramid, wedge or hexahedron, its faces split around their
/// centres.
double volume_of(const AnyMesh& mesh, int element);

/// Turns the wedges around if most of their volume is negative: files have them in both orders, as
/// VTK's own documentation and its shape functions differ. Adds a note.
void orient_wedges(AnyMesh& mesh);

/// \throws ReadError if an element refers to a point that is not there, a coordinate is not finite,
/// or there is no element.
void check_mesh_is_sound(const AnyMesh& mesh);

}  // namespace hexwall
