// VTK's unstructured grids: XML (.vtu) and legacy (.vtk).

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/errors.h"
#include "inspect/element_kinds.h"
#include "inspect/face_mesh.h"
#include "inspect/read_mesh.h"
#include "surface/number_source.h"
#include "surface/read_legacy_vtk.h"
#include "surface/vtk_pieces.h"
#include "surface/vtk_xml.h"

namespace hexwall {
namespace {

using Corners = std::vector<int>;

std::optional<ElementShape> shape_of(int type, std::size_t corners) {
  switch (type) {
    case VTK_TRIANGLE:
    case VTK_QUADRATIC_TRIANGLE:
      return ElementShape::triangle;
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_QUAD:
    case VTK_BIQUADRATIC_QUAD:
      return ElementShape::quad;
    case VTK_POLYGON:
      if (corners == 3) return ElementShape::triangle;
      return corners == 4 ? ElementShape::quad : ElementShape::polygon;
    case VTK_TETRA:
    case VTK_QUADRATIC_TETRA:
      return ElementShape::tetrahedron;
    case VTK_VOXEL:
    case VTK_HEXAHEDRON:
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
      return ElementShape::hexahedron;
    case VTK_WEDGE:
    case VTK_QUADRATIC_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      return ElementShape::wedge;
    case VTK_PYRAMID:
    case VTK_QUADRATIC_PYRAMID:
      return ElementShape::pyramid;
    default:
      return std::nullopt;
  }
}

bool is_point_or_line(int type) {
  return type == VTK_EMPTY_CELL || type == VTK_VERTEX || type == VTK_POLY_VERTEX ||
         type == VTK_LINE || type == VTK_POLY_LINE || type == VTK_QUADRATIC_EDGE;
}

// Voxels and pixels run in rows.
void order_corners(int type, Corners& corners) {
  if (type == VTK_PIXEL && corners.size() == 4) std::swap(corners[2], corners[3]);
  if (type == VTK_VOXEL && corners.size() == 8) {
    std::swap(corners[2], corners[3]);
    std::swap(corners[6], corners[7]);
  }
}

void add_strip(const Corners& strip, std::int64_t label, ElementCollector& collector) {
  for (std::size_t k = 0; k + 2 < strip.size(); ++k) {
    const std::size_t odd = k % 2;
    const std::array triangle{strip[k + odd], strip[k + 1 - odd], strip[k + 2]};
    collector.add(ElementShape::triangle, triangle, label);
  }
}

AnyMesh mesh_of(VtkGrid grid) {
  AnyMesh mesh;
  mesh.points = std::move(grid.points);
  ElementCollector collector(mesh);
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    Corners& corners = grid.cells[i];
    const int type = grid.types[i];
    const auto label = static_cast<std::int64_t>(i);
    order_corners(type, corners);
    const std::optional<ElementShape> shape = shape_of(type, corners.size());
    if (shape) {
      if (!collector.add(*shape, corners, label)) {
        throw ReadError(fmt::format("cell {}, a {}, has only {}", i, name(*shape),
                                    counted(corners.size(), "corner")));
      }
    } else if (type == VTK_TRIANGLE_STRIP) {
      add_strip(corners, label, collector);
    } else if (type == VTK_POLYHEDRON) {
      mesh.add(ElementShape::polyhedron, vertices_of_stream(corners, label), label);
      mesh.polyhedron_faces[mesh.size() - 1] = std::move(corners);
    } else if (is_point_or_line(type)) {
      collector.leave_out_lower();
    } else {
      collector.leave_out_unknown();
    }
  }
  collector.finish();
  return mesh;
}

// The face streams of polyhedra take the place of their corners.
void take_face_streams(const VtkXmlFile& file, const XmlElement& cells, const PointRange& points,
                       std::size_t first_cell, VtkGrid& grid) {
  const std::size_t count = grid.types.size() - first_cell;
  const auto* begin = grid.types.data() + first_cell;
  if (std::find(begin, begin + count, VTK_POLYHEDRON) == begin + count) return;
  const std::vector<double> ends = numbers_of(file, array_named(cells, "faceoffsets"), count);
  const double size = *std::max_element(ends.begin(), ends.end());
  if (!(size >= 0.0 && size < static_cast<double>(most_tuples))) {
    throw ReadError("the faces of polyhedra do not end where they should");
  }
  const std::vector<double> faces =
      numbers_of(file, array_named(cells, "faces"), static_cast<std::size_t>(size));
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (grid.types[first_cell + i] != VTK_POLYHEDRON) continue;
    Corners& stream = grid.cells[first_cell + i];
    stream.clear();
    for (; at < faces.size() && static_cast<double>(at) < ends[i]; ++at) {
      stream.push_back(index_of(faces[at]));
    }
    offset_stream(stream, static_cast<int>(points.first));
  }
}

void add_piece(const VtkXmlFile& file, const XmlElement& piece, VtkGrid& grid) {
  const PointRange points{grid.points.size(), count_in(piece, "NumberOfPoints")};
  add_points(file, piece, points.count, grid.points);
  const std::size_t count = count_in(piece, "NumberOfCells");
  if (count == 0) return;
  const XmlElement* cells = piece.child("Cells");
  if (cells == nullptr) throw ReadError("a piece has no cells");
  const std::size_t first_cell = grid.types.size();
  for (const double type : numbers_of(file, array_named(*cells, "types"), count)) {
    grid.types.push_back(index_of(type));
  }
  for (Corners& corners : cells_in(file, *cells, count, points)) {
    grid.cells.push_back(std::move(corners));
  }
  take_face_streams(file, *cells, points, first_cell, grid);
}

}  // namespace

AnyMesh parse_vtu(const std::string& content) {
  const VtkXmlFile file = parse_vtk_xml(content);
  const XmlElement* data = file.root.child("UnstructuredGrid");
  if (file.root.name != "VTKFile" || data == nullptr) {
    throw ReadError("this is not VTK's XML format for unstructured grids (UnstructuredGrid)");
  }
  VtkGrid grid;
  for (const XmlElement& piece : data->children) {
    if (piece.name == "Piece") add_piece(file, piece, grid);
  }
  return mesh_of(std::move(grid));
}

AnyMesh parse_vtk_grid(const std::string& content) {
  return mesh_of(parse_legacy_vtk_grid(content));
}

}  // namespace hexwall
