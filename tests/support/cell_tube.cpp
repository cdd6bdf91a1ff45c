#include "support/cell_tube.h"

#include <array>
#include <cmath>
#include <numbers>

namespace hexwall {
namespace {

using Quad = std::array<int, 4>;

/// A cross-section seen against z: quads counter-clockwise from z > 0, and its outermost vertices.
struct Layout {
  std::vector<Vec3> points;
  std::vector<Quad> quads;
  std::vector<int> rim;
  int core_quads = 0;
};

Vec3 core_point(double x, double y) {
  constexpr double half = 0.6;
  constexpr double roundness = 0.5;
  return {half * x * std::sqrt(1.0 - 0.5 * roundness * y * y),
          half * y * std::sqrt(1.0 - 0.5 * roundness * x * x), 0.0};
}

void add_core(const CellTube& t, Layout& layout) {
  const int n = t.across;
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      layout.points.push_back(core_point(2.0 * i / n - 1.0, 2.0 * j / n - 1.0));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      layout.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  layout.core_quads = n * n;
  for (int k = 0; k < n; ++k) layout.rim.push_back(at(k, 0));
  for (int k = 0; k < n; ++k) layout.rim.push_back(at(n, k));
  for (int k = n; k > 0; --k) layout.rim.push_back(at(k, n));
  for (int k = n; k > 0; --k) layout.rim.push_back(at(0, k));
}

void add_rings(const CellTube& t, Layout& layout) {
  const std::vector<int> core = layout.rim;
  const int around = static_cast<int>(core.size());
  for (int r = 1; r <= t.rings; ++r) {
    const int first = static_cast<int>(layout.points.size());
    std::vector<int> next;
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / around - 0.75 * std::numbers::pi;
      const Vec3 outer(std::cos(angle), std::sin(angle), 0.0);
      const double s = static_cast<double>(r) / t.rings;
      layout.points.emplace_back((1.0 - s) * layout.points[core[k]] + s * outer);
      next.push_back(first + k);
    }
    for (int k = 0; k < around; ++k) {
      const int l = (k + 1) % around;
      layout.quads.push_back({layout.rim[k], next[k], next[l], layout.rim[l]});
    }
    layout.rim = next;
  }
}

Layout layout_of(const CellTube& t) {
  Layout layout;
  add_core(t, layout);
  add_rings(t, layout);
  for (Vec3& p : layout.points) p = p.cwiseProduct(Vec3(t.radius_x, t.radius_y, 1.0));
  return layout;
}

double area_of(const Layout& layout) {
  double area = 0.0;
  for (std::size_t k = 0; k < layout.rim.size(); ++k) {
    const Vec3& a = layout.points[layout.rim[k]];
    const Vec3& b = layout.points[layout.rim[(k + 1) % layout.rim.size()]];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

/// Cells of one slice, and those of their faces that are on the boundary.
void add_slice(const CellTube& t, const Layout& layout, int j, CellMesh& mesh) {
  const int size = static_cast<int>(layout.points.size());
  const int low = j * size;
  const int high = low + size;
  const int first = mesh.cells();
  for (const Quad& q : layout.quads) {
    const int cell = mesh.cells();
    mesh.add(CellShape::hexahedron, std::array{q[0] + low, q[1] + low, q[2] + low, q[3] + low,
                                               q[0] + high, q[1] + high, q[2] + high, q[3] + high});
    mesh.zones[0].cells.push_back(cell);
    if (j == 0) mesh.patches[1].faces.push_back({{q[0], q[3], q[2], q[1]}, cell});
    if (j == t.along - 1) {
      mesh.patches[2].faces.push_back({{q[0] + high, q[1] + high, q[2] + high, q[3] + high}, cell});
    }
  }
  const int around = static_cast<int>(layout.rim.size());
  const int outermost = first + static_cast<int>(layout.quads.size()) - around;
  for (int k = 0; k < around; ++k) {
    const int a = layout.rim[k];
    const int b = layout.rim[(k + 1) % around];
    mesh.patches[0].faces.push_back({{a + low, b + low, b + high, a + high}, outermost + k});
  }
}

}  // namespace

CellMesh cell_tube(const CellTube& t) {
  const Layout layout = layout_of(t);
  CellMesh mesh;
  mesh.patches = {{"wall", true, {}}, {"inlet", false, {}}, {"outlet", false, {}}};
  mesh.zones = {{"lumen", {}}};
  for (int j = 0; j <= t.along; ++j)
    for (const Vec3& p : layout.points)
      mesh.points.emplace_back(p.x(), p.y(), t.length * j / t.along);
  for (int j = 0; j < t.along; ++j) add_slice(t, layout, j, mesh);
  mesh.regions = mesh.zones;
  return mesh;
}

std::vector<LumenOpening> openings(const CellTube& t) {
  const double area = area_of(layout_of(t));
  const double radius = std::sqrt(area / std::numbers::pi);
  return {{"inlet", true, Vec3::Zero(), -Vec3::UnitZ(), area, radius},
          {"outlet", false, Vec3(0.0, 0.0, t.length), Vec3::UnitZ(), area, radius}};
}

CellDisc cross_section(const CellTube& t) {
  const Layout layout = layout_of(t);
  CellDisc disc{layout.points, {}};
  for (int i = 0; i < static_cast<int>(layout.quads.size()); ++i) {
    const Quad& q = layout.quads[i];
    if (t.triangles && i < layout.core_quads) {
      disc.faces.push_back({{q[0], q[3], q[2], -1}, i});
      disc.faces.push_back({{q[0], q[2], q[1], -1}, i});
    } else {
      disc.faces.push_back({{q[0], q[3], q[2], q[1]}, i});
    }
  }
  return disc;
}

}  // namespace hexwall
