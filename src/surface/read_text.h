#pragma once

#include <string>

#include "surface/polygon_soup.h"

namespace hexwall {

/// Readers of the formats that are simple enough to be read without a library, which keeps double
/// precision and the file's own sharing of points. `content` is the whole file.
/// \throws ReadError if the text is not of the format; the message names the line.

/// STL, text or binary (little-endian). Three points per triangle: weld them afterwards.
PolygonSoup parse_stl(const std::string& content);

/// Wavefront OBJ: `v` and `f` with absolute or relative indices; texture coordinates, normals,
/// groups and materials are skipped; `l` and `p` elements are left out with a note.
PolygonSoup parse_obj(const std::string& content);

/// OFF, also with per-vertex data (COFF, NOFF, ...), which is skipped. Text only.
PolygonSoup parse_off(const std::string& content);

}  // namespace hexwall
