#include "support/vtk_text.h"

#include <fstream>

namespace hexwall::test {
namespace {

void write_scalars(std::ofstream& file, const char* section, const Scalars& scalars) {
  if (scalars.values.empty()) return;
  file << section << ' ' << scalars.values.size() << "\nSCALARS " << scalars.name
       << " double 1\nLOOKUP_TABLE default\n";
  for (const double value : scalars.values) file << value << '\n';
}

}  // namespace

void write_vtk_text(const std::filesystem::path& path, const TriangleSurface& surface,
                    const Scalars& at_points, const Scalars& of_triangles) {
  std::ofstream file(path);
  file.precision(17);
  file << "# vtk DataFile Version 3.0\nsurface\nASCII\nDATASET POLYDATA\nPOINTS "
       << surface.points.size() << " double\n";
  for (const Vec3& p : surface.points) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  file << "POLYGONS " << surface.triangles.size() << ' ' << 4 * surface.triangles.size() << '\n';
  for (const auto& [a, b, c] : surface.triangles) file << "3 " << a << ' ' << b << ' ' << c << '\n';
  write_scalars(file, "CELL_DATA", of_triangles);
  write_scalars(file, "POINT_DATA", at_points);
}

}  // namespace hexwall::test
