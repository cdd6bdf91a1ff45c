#include "surface/vtk_pieces.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "surface/number_source.h"

namespace hexwall {

std::size_t count_in(const XmlElement& element, std::string_view attribute, std::size_t greatest) {
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
                std::vector<Vec3>& into) {
  if (count == 0) return;
  const XmlElement* points = piece.child("Points");
  const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
  if (array == nullptr) throw ReadError("a piece has no points");
  const std::vector<double> x = numbers_of(file, *array, 3 * count);
  for (std::size_t i = 0; i < x.size(); i += 3) into.emplace_back(x[i], x[i + 1], x[i + 2]);
}

int corner_of(double corner, const PointRange& points) {
  const int index = index_of(corner);
  const bool is_inside = index >= 0 && static_cast<std::size_t>(index) < points.count;
  return is_inside ? static_cast<int>(points.first) + index : -1;
}

std::vector<std::vector<int>> cells_in(const VtkXmlFile& file, const XmlElement& element,
                                       std::size_t count, const PointRange& points) {
  const std::vector<double> ends = numbers_of(file, array_named(element, "offsets"), count);
  double before = 0.0;
  for (std::size_t i = 0; i < count; before = ends[i++]) {
    if (ends[i] >= before && ends[i] < static_cast<double>(most_tuples)) continue;
    throw ReadError(fmt::format("cell {} of '{}' does not end where it should", i, element.name));
  }
  const auto size = static_cast<std::size_t>(ends.empty() ? 0.0 : ends.back());
  const std::vector<double> corners = numbers_of(file, array_named(element, "connectivity"), size);
  std::vector<std::vector<int>> cells;
  std::size_t k = 0;
  for (const double end : ends) {
    std::vector<int>& cell = cells.emplace_back();
    for (; static_cast<double>(k) < end; ++k) {
      cell.push_back(corner_of(corners[k], points));
    }
  }
  return cells;
}

}  // namespace hexwall
