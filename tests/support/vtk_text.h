#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "surface/triangle_surface.h"

namespace hexwall::test {

/// A named array of scalars.
struct Scalars {
  std::string name;
  std::vector<double> values;
};

/// Writes a legacy VTK file with an array of scalars at the points or the triangles, unless empty.
void write_vtk_text(const std::filesystem::path& path, const TriangleSurface& surface,
                    const Scalars& at_points, const Scalars& of_triangles = {});

}  // namespace hexwall::test
