#pragma once

#include <filesystem>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Writes a surface in the format that the extension names, in upper or lower case: .stl (binary,
/// single precision), .ply, .vtp and .vtk (binary, exact), .obj and .off (text, exact). The file
/// appears under its name only once it is complete. \throws WriteError if the extension is unknown
/// or the file cannot be written.
void write_surface(const std::filesystem::path& path, const TriangleSurface& surface);

}  // namespace hexwall
