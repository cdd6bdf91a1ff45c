#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "surface/triangle_surface.h"
#include "surface/vtk_xml.h"

namespace hexwall {

/// The points of a piece among those of all pieces.
struct PointRange {
  std::size_t first, count;
};

inline constexpr std::size_t most_tuples = 1UL << 31;  ///< indices are of type int

/// A count that a piece announces, 0 if it does not. \throws ReadError if it is too great.
std::size_t count_in(const XmlElement& element, std::string_view attribute,
                     std::size_t greatest = most_tuples);

/// \throws ReadError if `parent` has no such array.
const XmlElement& array_named(const XmlElement& parent, const std::string& name);

/// Appends the points of a piece. \throws ReadError if there are fewer than `count`.
void add_points(const VtkXmlFile& file, const XmlElement& piece, std::size_t count,
                std::vector<Vec3>& points);

/// An index of a piece as one of all pieces; -1 out of the piece's range, which is refused.
int corner_of(double corner, const PointRange& points);

/// Corners of the cells of an element with `offsets` and `connectivity`.
/// \throws ReadError if these don't fit together.
std::vector<std::vector<int>> cells_in(const VtkXmlFile& file, const XmlElement& element,
                                       std::size_t count, const PointRange& points);

}  // namespace hexwall
