#include "support/faults.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "surface/connectivity.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

constexpr int around = 48;
constexpr int along = 24;
constexpr int middle_triangle = 2 * around * along / 2;

/// An edge in the middle of the tube: its ends, and the third vertices of its two triangles.
struct Edge {
  int f, g;        // f has the edge from a to b, g from b to a
  int a, b, c, d;  // c in f, d in g
};

Edge edge_of(const TriangleSurface& surface, int f) {
  const Connectivity mesh = connectivity_of(surface);
  const int h = 3 * f;
  const int twin = mesh.twin(h);
  return {f, Connectivity::face(twin), mesh.tail(h), mesh.tip(h), mesh.apex(h), mesh.apex(twin)};
}

int add_point(TriangleSurface& surface, const Vec3& p) {
  surface.points.push_back(p);
  return static_cast<int>(surface.points.size()) - 1;
}

/// Splits triangle f at a point on its edge (a, b).
void split(TriangleSurface& surface, int f, int a, int b, int m) {
  std::array<int, 3> second = surface.triangles[f];
  std::replace(surface.triangles[f].begin(), surface.triangles[f].end(), b, m);
  std::replace(second.begin(), second.end(), a, m);
  surface.triangles.push_back(second);
}

/// The edge in the middle split in both triangles, at the fraction t and moved out by `offset`.
TriangleSurface tube_with_point_in_edge(double t, double offset) {
  TriangleSurface surface = sound_tube();
  const Edge e = edge_of(surface, middle_triangle);
  const Vec3 p = (1.0 - t) * surface.points[e.a] + t * surface.points[e.b];
  const int m = add_point(surface, p + offset * Vec3(p.x(), p.y(), 0.0).normalized());
  split(surface, e.f, e.a, e.b, m);
  split(surface, e.g, e.a, e.b, m);
  return surface;
}

/// Triangle f split by a point that lies almost on its edge (a, b): three triangles, one a cap.
TriangleSurface tube_with_cap(int f, double height) {
  TriangleSurface surface = sound_tube();
  const auto [a, b, c] = surface.triangles[f];
  const Vec3 foot = 0.5 * (surface.points[a] + surface.points[b]);
  const int m = add_point(surface, foot + height * (surface.points[c] - foot).normalized());
  surface.triangles[f] = {a, m, c};
  surface.triangles.push_back({m, b, c});
  surface.triangles.push_back({a, b, m});
  return surface;
}

TriangleSurface with_fin() {
  TriangleSurface surface = sound_tube();
  const auto& t = surface.triangles[middle_triangle];
  const int tip = add_point(surface, 1.2 * surface.points[t[0]]);
  surface.triangles.push_back(
      {surface.triangles[middle_triangle][0], surface.triangles[middle_triangle][1], tip});
  return surface;
}

TriangleSurface with_inner_wall() {
  TriangleSurface surface = cylinder(1.0, 30.0, 12, 60);
  const int center = add_point(surface, {0, 0, 15.0});
  const int ring = 12 * 30;
  for (int i = 0; i < 12; ++i) {
    surface.triangles.push_back({ring + i, ring + (i + 1) % 12, center});
  }
  return surface;
}

TriangleSurface with_repeated_triangles() {
  TriangleSurface surface = sound_tube();
  for (const int f : {100, 101, 200}) {
    const auto [a, b, c] = surface.triangles[f];
    surface.triangles.push_back({b, c, a});
  }
  std::swap(surface.triangles.back()[0], surface.triangles.back()[1]);
  return surface;
}

/// Two triangles covered once more by two with the other diagonal.
TriangleSurface with_doubled_patch() {
  TriangleSurface surface = sound_tube();
  const Edge e = edge_of(surface, middle_triangle);
  surface.triangles.push_back({e.a, e.d, e.c});
  surface.triangles.push_back({e.d, e.b, e.c});
  return surface;
}

TriangleSurface with_t_junction() {
  TriangleSurface surface = sound_tube();
  const Edge e = edge_of(surface, middle_triangle);
  const int m = add_point(surface, 0.5 * (surface.points[e.a] + surface.points[e.b]));
  split(surface, e.f, e.a, e.b, m);
  return surface;
}

/// Every triangle with points of its own, off by a rounding error.
TriangleSurface as_soup() {
  const TriangleSurface tube = sound_tube();
  TriangleSurface soup;
  for (const auto& t : tube.triangles) {
    const int n = static_cast<int>(soup.points.size());
    for (int k = 0; k < 3; ++k) {
      soup.points.push_back(tube.points[t[k]] + 1e-7 * std::sin(n + k) * Vec3(1, -1, 1));
    }
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

TriangleSurface with_repeated_vertex() {
  TriangleSurface surface = sound_tube();
  const Edge e = edge_of(surface, middle_triangle);
  surface.triangles.push_back({e.a, e.b, e.a});
  return surface;
}

/// A cap without height, on the middle edge: its neighbour has to run through its third vertex.
TriangleSurface with_flat_cap() {
  TriangleSurface surface = with_t_junction();
  const Edge e = edge_of(sound_tube(), middle_triangle);
  surface.triangles.push_back({e.a, e.b, static_cast<int>(surface.points.size()) - 1});
  return surface;
}

/// A small octahedron, one vertex of which is a vertex of the tube.
TriangleSurface with_touching_stray() {
  TriangleSurface surface = sound_tube();
  const int v = surface.triangles[middle_triangle][0];
  const Vec3 out = 0.05 * Vec3(surface.points[v].x(), surface.points[v].y(), 0.0).normalized();
  const Vec3 side = Vec3::UnitZ().cross(out);
  const Vec3 up = out.norm() * Vec3::UnitZ();
  const Vec3 center = surface.points[v] + out;
  std::array<int, 6> o{v, 0, 0, 0, 0, 0};
  const std::array<Vec3, 6> points{-out, side, -side, up, -up, out};
  for (int i = 1; i < 6; ++i) o[i] = add_point(surface, center + points[i]);
  for (const int tip : {o[0], o[5]}) {
    surface.triangles.push_back({o[1], o[3], tip});
    surface.triangles.push_back({o[3], o[2], tip});
    surface.triangles.push_back({o[2], o[4], tip});
    surface.triangles.push_back({o[4], o[1], tip});
  }
  return surface;
}

TriangleSurface with_strays() {
  TriangleSurface surface = sound_tube();
  append(surface, cylinder(0.02, 0.06, 5, 1), {3, 0, 0});
  append(surface, cylinder(0.02, 0.06, 5, 1), {0, 0, 1});
  return surface;
}

TriangleSurface with_turned_part() {
  TriangleSurface surface = sound_tube();
  for (int f = 500; f < 560; ++f) std::swap(surface.triangles[f][1], surface.triangles[f][2]);
  return surface;
}

TriangleSurface with_pinholes() {
  TriangleSurface surface = sound_tube();
  surface.triangles.erase(surface.triangles.begin() + 300);
  const int v = surface.triangles[middle_triangle][0];
  std::erase_if(surface.triangles,
                [v](const auto& t) { return t[0] == v || t[1] == v || t[2] == v; });
  return surface;
}

/// A vertex drawn sideways past its neighbour and under the wall there, which is dented so far that
/// both cross. It is drawn up a little as well: no edges meet that would leave it to rounding
/// whether their triangles touch.
TriangleSurface with_fold() {
  TriangleSurface surface = sound_tube();
  const int v = surface.triangles[middle_triangle][0];
  surface.points[v] += 1.2 * (surface.points[v + 1] - surface.points[v]) + Vec3(0, 0, 0.01);
  for (const int w : {v, v + 2}) {
    const Vec3 in(-surface.points[w].x(), -surface.points[w].y(), 0.0);
    surface.points[w] += (w == v ? 0.01 : 0.05) * in;
  }
  return surface;
}

}  // namespace

TriangleSurface sound_tube() {
  return cylinder(1.0, 3.0, around, along);
}

int append(TriangleSurface& surface, const TriangleSurface& other, const Vec3& offset) {
  const int first = static_cast<int>(surface.points.size());
  for (const Vec3& p : other.points) surface.points.push_back(p + offset);
  for (const auto& [a, b, c] : other.triangles) {
    surface.triangles.push_back({a + first, b + first, c + first});
  }
  return first;
}

std::vector<Fault> topology_faults() {
  const int corners = 3 * 2 * around * along;
  const int vertices = around * (along + 1);
  return {{"soup", RepairStep::weld, corners - vertices, as_soup()},
          {"t_junction",
           RepairStep::weld,
           1,
           with_t_junction(),
           {},
           {RepairStep::pinholes, RepairStep::slivers}},
          {"repeated_vertex",
           RepairStep::degenerate,
           1,
           with_repeated_vertex(),
           {},
           {RepairStep::nonmanifold}},
          {"needle_without_area", RepairStep::degenerate, 2, tube_with_point_in_edge(0.0, 0.0)},
          {"cap_without_area", RepairStep::degenerate, 1, with_flat_cap()},
          {"cap_without_area_at_the_end", RepairStep::degenerate, 1, tube_with_cap(0, 0.0)},
          {"repeated_triangles",
           RepairStep::duplicate,
           3,
           with_repeated_triangles(),
           {},
           {RepairStep::nonmanifold, RepairStep::orient}},
          {"fin", RepairStep::nonmanifold, 1, with_fin()},
          {"doubled_patch", RepairStep::nonmanifold, 1, with_doubled_patch()},
          {"inner_wall", RepairStep::nonmanifold, 1, with_inner_wall()},
          {"touching_stray",
           RepairStep::components,
           1,
           with_touching_stray(),
           {RepairStep::nonmanifold}},
          {"strays", RepairStep::components, 2, with_strays()},
          {"turned_part", RepairStep::orient, 60, with_turned_part()}};
}

std::vector<Fault> geometry_faults() {
  return {{"pinholes", RepairStep::pinholes, 2, with_pinholes()},
          {"needle", RepairStep::slivers, 1, tube_with_point_in_edge(1e-3, 0.0)},
          {"cap", RepairStep::slivers, 1, tube_with_cap(middle_triangle, 1e-4)},
          {"cap_at_the_end", RepairStep::slivers, 1, tube_with_cap(0, 1e-4)},
          {"long_triangles", RepairStep::remesh, 1, cylinder(1.0, 5.0, 64, 1)},
          {"fold", RepairStep::intersections, 7, with_fold()}};
}

}  // namespace hexwall::test
