#pragma once

#include <string>

#include "surface/polygon_soup.h"

namespace hexwall {

/// VTK's XML format for polygonal data, in all encodings: text, base64, raw or compressed, of
/// either byte order, in one or several pieces. `content` is the whole file. Triangle strips are
/// converted; vertex and line cells are left out with a note. Arrays of numbers are kept, those
/// without a name or of the wrong length are not. VTK's own reader is of no use here: it believes
/// what a file says of its sizes and fills the memory or crashes.
/// Source: "VTK XML Formats" in the VTK User's Guide.
/// \throws ReadError if the file is not of the format, truncated or damaged.
/// Not to be called by several threads at the same time (VTK uncompresses, and its message window
/// is global).
PolygonSoup parse_vtp(const std::string& content);

}  // namespace hexwall
