#pragma once

#include "surface/polygon_soup.h"
#include "surface/read.h"

namespace hexwall {

/// What `read_surface` makes of a file once it is read, for a surface in memory: polygons split
/// into triangles, points that none uses left out, slits closed; arrays come along.
/// \throws ReadError where `triangulate` does.
ReadResult read_memory(PolygonSoup soup);

}  // namespace hexwall
