#pragma once

#include <filesystem>

#include "surface/polygon_soup.h"

namespace hexwall {

/// Readers by VTK. Triangle strips are converted; vertex, line and volume cells are left out with
/// a note. Arrays of numbers are kept, those without a name or of the wrong length are not. VTK's
/// own messages become part of the error instead of going to the console; for that VTK's global
/// message window is replaced for the duration: not to be called by several threads at the same
/// time. \throws ReadError with VTK's message if VTK reports an error.

/// VTK's XML format for polygonal data.
PolygonSoup read_vtp(const std::filesystem::path& path);

/// VTK's legacy format, text or binary: polygonal data or an unstructured grid.
PolygonSoup read_legacy_vtk(const std::filesystem::path& path);

}  // namespace hexwall
