#include "surface/read_vtp.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/errors.h"
#include "surface/number_source.h"
#include "surface/vtk_cells.h"
#include "surface/vtk_xml.h"

namespace hexwall {
namespace {

constexpr std::size_t most_components = 1000;
constexpr std::size_t most_tuples = 1UL << 31;  // indices are of type int

struct Part {
  std::string_view element, count;
  int type;
};

// In the order in which VTK numbers the cells.
constexpr std::array<Part, 4> parts{{{"Verts", "NumberOfVerts", VTK_POLY_VERTEX},
                                     {"Lines", "NumberOfLines", VTK_POLY_LINE},
                                     {"Polys", "NumberOfPolys", VTK_POLYGON},
                                     {"Strips", "NumberOfStrips", VTK_TRIANGLE_STRIP}}};

std::size_t count_in(const XmlElement& element, std::string_view attribute,
                     std::size_t greatest = most_tuples) {
  const std::size_t count = count_of(element.attribute(attribute, "0"));
  if (count > greatest) throw ReadError(fmt::format("{} is {}", attribute, count));
  return count;
}

const XmlElement& array_named(const XmlElement& parent, const std::string& name) {
  for (const XmlElement& array : parent.children) {
    if (array.name == "DataArray" && array.attribute("Name") == name) return array;
  }
  throw ReadError(fmt::format("the array '{}' is missing in '{}'", name, parent.name));
}

void add_points(const VtkXmlFile& file, const XmlElement& piece, std::size_t count,
                PolygonSoup& soup) {
  if (count == 0) return;
  const XmlElement* points = piece.child("Points");
  const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
  if (array == nullptr) throw ReadError("a piece has no points");
  const std::vector<double> x = numbers_of(file, *array, 3 * count);
  for (std::size_t i = 0; i < x.size(); i += 3) soup.points.emplace_back(x[i], x[i + 1], x[i + 2]);
}

/// The points of a piece among those of all pieces.
struct PointRange {
  std::size_t first, count;
};

// Corners out of the piece's range become -1, which is refused.
int corner_of(double corner, const PointRange& points) {
  const int index = index_of(corner);
  const bool is_inside = index >= 0 && static_cast<std::size_t>(index) < points.count;
  return is_inside ? static_cast<int>(points.first) + index : -1;
}

void add_cells(const VtkXmlFile& file, const XmlElement& element, std::size_t count, int type,
               const PointRange& points, VtkCells& cells) {
  const std::vector<double> ends = numbers_of(file, array_named(element, "offsets"), count);
  double before = 0.0;
  for (std::size_t i = 0; i < count; before = ends[i++]) {
    if (ends[i] >= before && ends[i] < static_cast<double>(most_tuples)) continue;
    throw ReadError(fmt::format("cell {} of '{}' does not end where it should", i, element.name));
  }
  const auto size = static_cast<std::size_t>(ends.empty() ? 0.0 : ends.back());
  const std::vector<double> corners = numbers_of(file, array_named(element, "connectivity"), size);
  std::size_t k = 0;
  for (const double end : ends) {
    std::vector<int> cell;
    for (; static_cast<double>(k) < end; ++k) {
      cell.push_back(corner_of(corners[k], points));
    }
    cells.add(type, std::move(cell));
  }
}

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
  add_points(file, piece, points.count, sum.soup);
  std::size_t cell_count = 0;
  for (const Part& part : parts) {
    const std::size_t count = count_in(piece, part.count);
    if (count == 0) continue;
    const XmlElement* element = piece.child(part.element);
    if (element == nullptr)
      throw ReadError(fmt::format("the element '{}' is missing", part.element));
    add_cells(file, *element, count, part.type, points, sum.cells);
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
