#pragma once

#include <string>

#include "surface/polygon_soup.h"

namespace hexwall {

/// PLY, text or binary of either byte order, as double precision: `x`, `y`, `z` of the element
/// `vertex` and `vertex_indices` (or `vertex_index`) of `face`. Other properties of the two that
/// are no lists become arrays, but for normals; all else is skipped, triangle strips are refused.
/// `content` is the whole file. VTK's reader is of no use here: it rounds to single precision and
/// crashes on truncated files. \throws ReadError if the file is not of the format or truncated.
PolygonSoup parse_ply(const std::string& content);

}  // namespace hexwall
