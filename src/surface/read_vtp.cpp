#include "surface/read_vtp.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/errors.h"
#include "surface/number_source.h"
#include "surface/vtk_cells.h"
#include "surface/vtk_pieces.h"
#include "surface/vtk_xml.h"

namespace hexwall {
namespace {

constexpr std::size_t most_components = 1000;

struct Part {
  std::string_view element, count;
  int type;
};

// In the order in which VTK numbers the cells.
constexpr std::array<Part, 4> parts{{{"Verts", "NumberOfVerts", VTK_POLY_VERTEX},
                                     {"Lines", "NumberOfLines", VTK_POLY_LINE},
                                     {"Polys", "NumberOfPolys", VTK_POLYGON},
                                     {"Strips", "NumberOfStrips", VTK_TRIANGLE_STRIP}}};

/// Arrays of several pieces, one behind the other.
class Arrays {
 public:
  void add(const VtkXmlFile& file, const XmlElement* parent, std::size_t tuples) {
    if (parent == nullptr) return;
    for (const XmlElement& array : parent->children) {
      const std::string name = array.attribute("Name");
      if (array.name != "DataArray" || name.empty()) continue;
      const std::string components = array.attribute("NumberOfComponents", "1");
      const std::size_t width = count_of(components);
      if (width == 0 || width > most_components) {
        throw ReadError(fmt::format("the array '{}' has {} components", name, width));
      }
      append(name, static_cast<int>(width), numbers_of(file, array, tuples * width));
    }
  }

  /// Those that go through all pieces.
  std::vector<SurfaceArray> complete(std::size_t tuples, std::vector<std::string>& notes) {
    std::vector<SurfaceArray> result;
    for (SurfaceArray& array : arrays_) {
      if (array.values.size() == tuples * array.components) {
        result.push_back(std::move(array));
      } else {
        notes.push_back(
            fmt::format("the array '{}' was ignored: not all pieces have it", array.name));
      }
    }
    return result;
  }

 private:
  void append(const std::string& name, int components, std::vector<double> values) {
    for (SurfaceArray& array : arrays_) {
      if (array.name != name || array.components != components) continue;
      array.values.insert(array.values.end(), values.begin(), values.end());
      return;
    }
    arrays_.push_back({name, components, std::move(values)});
  }

  std::vector<SurfaceArray> arrays_;
};

/// What the pieces of a file add up to.
struct Sum {
  PolygonSoup soup;
  VtkCells cells;
  std::size_t cell_count = 0;
  Arrays point_arrays, cell_arrays;
};

void add_piece(const VtkXmlFile& file, const XmlElement& piece, Sum& sum) {
  const PointRange points{sum.soup.points.size(), count_in(piece, "NumberOfPoints")};
  add_points(file, piece, points.count, sum.soup.points);
  std::size_t cell_count = 0;
  for (const Part& part : parts) {
    const std::size_t count = count_in(piece, part.count);
    if (count == 0) continue;
    const XmlElement* element = piece.child(part.element);
    if (element == nullptr)
      throw ReadError(fmt::format("the element '{}' is missing", part.element));
    for (std::vector<int>& corners : cells_in(file, *element, count, points)) {
      sum.cells.add(part.type, std::move(corners));
    }
    cell_count += count;
  }
  sum.cell_count += cell_count;
  sum.point_arrays.add(file, piece.child("PointData"), points.count);
  sum.cell_arrays.add(file, piece.child("CellData"), cell_count);
}

}  // namespace

PolygonSoup parse_vtp(const std::string& content) {
  const VtkXmlFile file = parse_vtk_xml(content);
  const XmlElement* data = file.root.child("PolyData");
  if (file.root.name != "VTKFile" || data == nullptr) {
    throw ReadError("this is not VTK's XML format for polygonal data (PolyData)");
  }
  Sum sum;
  for (const XmlElement& piece : data->children) {
    if (piece.name == "Piece") add_piece(file, piece, sum);
  }
  PolygonSoup soup = std::move(sum.soup);
  sum.cells.move_to(soup);
  soup.point_arrays = sum.point_arrays.complete(soup.points.size(), soup.notes);
  soup.polygon_arrays =
      follow(sum.cell_arrays.complete(sum.cell_count, soup.notes), sum.cells.cell_of_polygon());
  return soup;
}

}  // namespace hexwall
