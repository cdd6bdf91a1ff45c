#include "surface/polygon_soup.h"

#include <array>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

#include "core/errors.h"
#include "surface/counted.h"
#include "surface/edge_uses.h"
#include "surface/point_bits.h"

namespace hexwall {
namespace {

void check_polygons(const PolygonSoup& soup) {
  const int n = static_cast<int>(soup.points.size());
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    if (soup.polygons[f].size() < 3) {
      throw ReadError(
          fmt::format("face {} has {} corners: at least 3 are needed", f, soup.polygons[f].size()));
    }
    for (const int v : soup.polygons[f]) {
      if (v >= 0 && v < n) continue;
      throw ReadError(
          fmt::format("face {} refers to point {} (counted from 0), which is out of "
                      "range: the file has {} points",
                      f, v, n));
    }
  }
}

void split_quad(const std::vector<Vec3>& p, const std::vector<int>& q,
                std::vector<std::array<int, 3>>& out) {
  if ((p[q[2]] - p[q[0]]).squaredNorm() <= (p[q[3]] - p[q[1]]).squaredNorm()) {
    out.push_back({q[0], q[1], q[2]});
    out.push_back({q[0], q[2], q[3]});
  } else {
    out.push_back({q[0], q[1], q[3]});
    out.push_back({q[1], q[2], q[3]});
  }
}

void cut_ears(const std::vector<Vec3>& p, const std::vector<int>& corners, std::size_t face,
              std::vector<std::array<int, 3>>& out) {
  vtkNew<vtkPolygon> polygon;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    polygon->GetPoints()->InsertNextPoint(p[corners[k]].data());
    polygon->GetPointIds()->InsertNextId(static_cast<vtkIdType>(k));
  }
  vtkNew<vtkIdList> ears;
  if (polygon->Triangulate(ears) == 0) {
    throw ReadError(
        fmt::format("face {} with {} corners could not be split into triangles: it "
                    "crosses itself or has no area. Triangulate it before",
                    face, corners.size()));
  }
  for (vtkIdType i = 0; i + 2 < ears->GetNumberOfIds(); i += 3) {
    out.push_back(
        {corners[ears->GetId(i)], corners[ears->GetId(i + 1)], corners[ears->GetId(i + 2)]});
  }
}

std::vector<bool> boundary_vertices(const TriangleSurface& surface) {
  std::vector<bool> is_boundary(surface.points.size(), false);
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    if (last - first == 1) is_boundary[first->low] = is_boundary[first->high] = true;
  });
  return is_boundary;
}

// Two boundary vertices in the same place are a slit that some program left (at the seam of a tube,
// say). Such a surface touches itself and would be refused: merging can only help.
void close_slits(TriangleSurface& surface, std::vector<std::string>& notes) {
  const std::vector<bool> is_boundary = boundary_vertices(surface);
  std::unordered_map<PointBits, int, PointBitsHash> first;
  std::vector<int> merged(surface.points.size());
  int count = 0;
  for (int v = 0; v < static_cast<int>(merged.size()); ++v) {
    merged[v] = is_boundary[v] ? first.try_emplace(bits_of(surface.points[v]), v).first->second : v;
    if (merged[v] != v) ++count;
  }
  if (count == 0) return;
  for (auto& t : surface.triangles) {
    for (int& v : t) v = merged[v];
  }
  notes.push_back(counted(
      count, "boundary point that repeats another one was merged with it, which closed a slit",
      "boundary points that repeat another one were merged with it, which closed a slit"));
}

/// Returns how many there were. `origin` follows the points.
std::size_t drop_unused_points(TriangleSurface& surface, std::vector<int>& origin) {
  std::vector<int> renumbered(surface.points.size(), -1);
  for (const auto& t : surface.triangles) {
    for (const int v : t) renumbered[v] = 0;
  }
  int used = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] < 0) continue;
    surface.points[used] = surface.points[v];
    origin[used] = origin[v];
    renumbered[v] = used++;
  }
  const std::size_t unused = surface.points.size() - static_cast<std::size_t>(used);
  surface.points.resize(used);
  origin.resize(used);
  for (auto& t : surface.triangles) {
    for (int& v : t) v = renumbered[v];
  }
  return unused;
}

}  // namespace

void weld_equal_points(PolygonSoup& soup) {
  std::unordered_map<PointBits, int, PointBitsHash> first;
  std::vector<int> welded(soup.points.size());
  std::vector<int> origin;
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const auto [it, is_new] =
        first.try_emplace(bits_of(soup.points[v]), static_cast<int>(points.size()));
    if (is_new) {
      points.push_back(soup.points[v]);
      origin.push_back(static_cast<int>(v));
    }
    welded[v] = it->second;
  }
  soup.points = std::move(points);
  soup.point_arrays = follow(soup.point_arrays, origin);
  for (auto& polygon : soup.polygons) {
    for (int& v : polygon) v = welded[v];
  }
}

TriangulateResult triangulate(PolygonSoup& soup) {
  check_polygons(soup);
  TriangulateResult result;
  TriangleSurface& surface = result.surface;
  surface.points = std::move(soup.points);
  int quads = 0;
  int polygons = 0;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const std::vector<int>& corners = soup.polygons[f];
    if (corners.size() == 3) {
      surface.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() == 4) {
      split_quad(surface.points, corners, surface.triangles);
      ++quads;
    } else {
      cut_ears(surface.points, corners, f, surface.triangles);
      ++polygons;
    }
    result.triangle_origin.resize(surface.triangles.size(), static_cast<int>(f));
  }
  if (surface.triangles.empty()) throw ReadError("the file holds no triangles");
  if (quads > 0) {
    soup.notes.push_back(counted(quads, "quad was split on its shorter diagonal",
                                 "quads were split on their shorter diagonals"));
  }
  if (polygons > 0) {
    soup.notes.push_back(counted(polygons, "polygon was split into triangles",
                                 "polygons were split into triangles"));
  }
  result.point_origin.resize(surface.points.size());
  std::iota(result.point_origin.begin(), result.point_origin.end(), 0);
  if (const std::size_t unused = drop_unused_points(surface, result.point_origin); unused > 0) {
    soup.notes.push_back(counted(unused, "point that no triangle uses was left out",
                                 "points that no triangle uses were left out"));
  }
  close_slits(surface, soup.notes);
  drop_unused_points(surface, result.point_origin);
  return result;
}

}  // namespace hexwall
