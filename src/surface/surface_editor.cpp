#include "surface/surface_editor.h"

#include <algorithm>
#include <iterator>

namespace hexwall {
namespace {

bool has(const std::array<int, 3>& t, int v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

}  // namespace

int third_vertex(const std::array<int, 3>& triangle, int a, int b) {
  return *std::find_if(triangle.begin(), triangle.end(), [&](int v) { return v != a && v != b; });
}

std::array<int, 3> replaced(std::array<int, 3> triangle, int from, int to) {
  std::replace(triangle.begin(), triangle.end(), from, to);
  return triangle;
}

void keep_triangles(TriangleSurface& surface, std::vector<int>& origin,
                    const std::vector<bool>& keep) {
  std::vector<int> number(surface.points.size(), -1);
  int kept = 0;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    if (!keep[f]) continue;
    for (const int v : surface.triangles[f]) number[v] = 0;
    surface.triangles[kept] = surface.triangles[f];
    origin[kept++] = origin[f];
  }
  surface.triangles.resize(kept);
  origin.resize(kept);
  int used = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    surface.points[used] = surface.points[v];
    number[v] = used++;
  }
  surface.points.resize(used);
  for (auto& t : surface.triangles) {
    for (int& v : t) v = number[v];
  }
}

SurfaceEditor::SurfaceEditor(TriangleSurface& surface, std::vector<int>& origin)
    : surface_(surface),
      origin_(origin),
      alive_(surface.triangles.size(), true),
      faces_(surface.points.size()) {
  for (int f = 0; f < triangle_count(); ++f) {
    for (const int v : triangle(f)) faces_[v].push_back(f);
  }
}

std::vector<int> SurfaceEditor::faces_at(int a, int b) const {
  std::vector<int> result;
  std::copy_if(faces_[a].begin(), faces_[a].end(), std::back_inserter(result),
               [&](int f) { return has(triangle(f), b); });
  return result;
}

std::vector<int> SurfaceEditor::neighbours(int v) const {
  std::vector<int> result;
  for (const int f : faces_[v]) {
    std::copy_if(triangle(f).begin(), triangle(f).end(), std::back_inserter(result),
                 [v](int w) { return w != v; });
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool SurfaceEditor::is_boundary_vertex(int v) const {
  const std::vector<int> around = neighbours(v);
  return std::any_of(around.begin(), around.end(), [&](int w) { return is_boundary_edge(v, w); });
}

bool SurfaceEditor::can_merge(int u, int v) const {
  const std::vector<int> of_u = neighbours(u);
  const std::vector<int> of_v = neighbours(v);
  std::vector<int> common;
  std::set_intersection(of_u.begin(), of_u.end(), of_v.begin(), of_v.end(),
                        std::back_inserter(common));
  const std::vector<int> at_edge = faces_at(u, v);
  std::vector<int> opposite;
  for (const int f : at_edge) opposite.push_back(third_vertex(triangle(f), u, v));
  std::sort(opposite.begin(), opposite.end());
  if (common != opposite) return false;
  // Around the merged vertex at least 3 neighbours are left, or 2 at the boundary: parts of fewer
  // triangles would fold up.
  const bool is_boundary = at_edge.size() == 1;
  if (of_u.size() + of_v.size() - common.size() - 2 < (is_boundary ? 2 : 3)) return false;
  return is_boundary || !is_boundary_vertex(u) || !is_boundary_vertex(v);
}

void SurfaceEditor::remove(int f) {
  alive_[f] = false;
  for (const int v : triangle(f)) std::erase(faces_[v], f);
}

int SurfaceEditor::add(const std::array<int, 3>& triangle, int origin) {
  const int f = triangle_count();
  surface_.triangles.push_back(triangle);
  origin_.push_back(origin);
  alive_.push_back(true);
  for (const int v : triangle) faces_[v].push_back(f);
  return f;
}

void SurfaceEditor::merge(int u, int v) {
  const std::vector<int> moved = faces_[u];
  for (const int f : moved) {
    if (has(triangle(f), v)) {
      remove(f);
      continue;
    }
    surface_.triangles[f] = replaced(triangle(f), u, v);
    faces_[v].push_back(f);
  }
  faces_[u].clear();
}

void SurfaceEditor::finish() {
  keep_triangles(surface_, origin_, alive_);
}

}  // namespace hexwall
