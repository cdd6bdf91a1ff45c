#include "fuzz/mutated_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>

#include "support/capped.h"
#include "surface/generate.h"

namespace hexwall::test {
namespace {

constexpr std::size_t most_triangles = 1500;
constexpr int most_changes = 16;

// --- what changes need --------------------------------------------------------------------------

int any_point(const TriangleSurface& s, ByteSource& bytes) {
  return bytes.index(s.points.size());
}

int any_triangle(const TriangleSurface& s, ByteSource& bytes) {
  return bytes.index(s.triangles.size());
}

Vec3 any_vector(ByteSource& bytes) {
  const double x = bytes.fraction();
  const double y = bytes.fraction();
  return {x, y, bytes.fraction()};
}

/// 10^-12 to 10^12.
double any_magnitude(ByteSource& bytes) {
  return std::pow(10.0, 12.0 * bytes.fraction());
}

// --- changes of triangles -----------------------------------------------------------------------

void turn(TriangleSurface& s, ByteSource& bytes) {
  auto& triangle = s.triangles[any_triangle(s, bytes)];
  std::swap(triangle[0], triangle[1]);
}

void remove(TriangleSurface& s, ByteSource& bytes) {
  s.triangles.erase(s.triangles.begin() + any_triangle(s, bytes));
}

void repeat(TriangleSurface& s, ByteSource& bytes) {
  const std::array<int, 3> copy = s.triangles[any_triangle(s, bytes)];
  s.triangles.push_back(copy);
}

void add(TriangleSurface& s, ByteSource& bytes) {
  const int a = any_point(s, bytes);
  const int b = any_point(s, bytes);
  s.triangles.push_back({a, b, any_point(s, bytes)});
}

/// Takes out all triangles with a corner near a point.
void poke_hole(TriangleSurface& s, ByteSource& bytes) {
  const Vec3 center = s.points[any_point(s, bytes)];
  const double radius = 0.5 + bytes.fraction();
  std::erase_if(s.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](int v) { return !((s.points[v] - center).norm() > radius); });
  });
}

void weld(TriangleSurface& s, ByteSource& bytes) {
  const int kept = any_point(s, bytes);
  const int gone = any_point(s, bytes);
  for (auto& triangle : s.triangles) std::replace(triangle.begin(), triangle.end(), gone, kept);
}

/// Welds a corner of a triangle to another one of it: an edge collapses.
void collapse(TriangleSurface& s, ByteSource& bytes) {
  const std::array<int, 3> t = s.triangles[any_triangle(s, bytes)];
  for (auto& triangle : s.triangles) std::replace(triangle.begin(), triangle.end(), t[0], t[1]);
}

/// Splits a triangle at a point of its plane, perhaps on its boundary or outside.
void split(TriangleSurface& s, ByteSource& bytes) {
  const int f = any_triangle(s, bytes);
  const auto [a, b, c] = s.triangles[f];
  const double u = bytes.fraction();
  const double v = bytes.fraction();
  const Vec3 p = u * s.points[a] + v * s.points[b] + (1.0 - u - v) * s.points[c];
  const int m = static_cast<int>(s.points.size());
  s.points.push_back(p);
  s.triangles[f] = {a, b, m};
  s.triangles.push_back({b, c, m});
  s.triangles.push_back({c, a, m});
}

void flip_edge(TriangleSurface& s, ByteSource& bytes) {
  auto& first = s.triangles[any_triangle(s, bytes)];
  const int a = first[0];
  const int b = first[1];
  for (auto& second : s.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (second[k] != b || second[(k + 1) % 3] != a) continue;
      const int d = second[(k + 2) % 3];
      second = {d, b, first[2]};
      first = {a, d, first[2]};
      return;
    }
  }
}

/// The same surface once more, elsewhere: inside, across, apart.
void add_copy(TriangleSurface& s, ByteSource& bytes) {
  const Vec3 shift = 4.0 * any_vector(bytes);
  const double scale = bytes.fraction();
  const TriangleSurface copy = s;
  const int first = static_cast<int>(s.points.size());
  for (const Vec3& p : copy.points) s.points.push_back(scale * p + shift);
  for (const auto& [a, b, c] : copy.triangles) {
    s.triangles.push_back({a + first, b + first, c + first});
  }
}

// --- changes of points --------------------------------------------------------------------------

void move(TriangleSurface& s, ByteSource& bytes) {
  const int v = any_point(s, bytes);
  s.points[v] += any_vector(bytes);
}

void spike(TriangleSurface& s, ByteSource& bytes) {
  const int v = any_point(s, bytes);
  s.points[v] *= any_magnitude(bytes);
}

void snap(TriangleSurface& s, ByteSource& bytes) {
  const int v = any_point(s, bytes);
  s.points[v] = s.points[any_point(s, bytes)];
}

/// A sac or a dent: points near one are drawn along a vector.
void draw(TriangleSurface& s, ByteSource& bytes) {
  const Vec3 center = s.points[any_point(s, bytes)];
  const Vec3 shift = 3.0 * any_vector(bytes);
  const double radius = 1.01 + bytes.fraction();
  for (Vec3& p : s.points) {
    p += std::exp(-(p - center).squaredNorm() / (radius * radius)) * shift;
  }
}

/// A tube becomes wider or narrower along its axis.
void taper(TriangleSurface& s, ByteSource& bytes) {
  const double rate = bytes.fraction();
  for (Vec3& p : s.points) p.head<2>() *= std::exp(rate * p.z());
}

void bend(TriangleSurface& s, ByteSource& bytes) {
  const double rate = bytes.fraction();
  for (Vec3& p : s.points) p.x() += rate * p.z() * p.z();
}

void stretch(TriangleSurface& s, ByteSource& bytes) {
  const int axis = bytes.index(3);
  const double scale = std::pow(10.0, 2.0 * bytes.fraction());
  for (Vec3& p : s.points) p[axis] *= scale;
}

void resize(TriangleSurface& s, ByteSource& bytes) {
  const double scale = any_magnitude(bytes);
  for (Vec3& p : s.points) p *= scale;
}

void shift_far(TriangleSurface& s, ByteSource& bytes) {
  const Vec3 shift = any_magnitude(bytes) * any_vector(bytes);
  for (Vec3& p : s.points) p += shift;
}

/// Points on a grid: many coincide, lie on lines and in planes.
void round_points(TriangleSurface& s, ByteSource& bytes) {
  const double cell = std::pow(10.0, 4.0 * bytes.fraction() - 3.0);
  for (Vec3& p : s.points) p = cell * (p / cell).array().round().matrix();
}

void shake(TriangleSurface& s, ByteSource& bytes) {
  const double amplitude = std::pow(10.0, 4.0 * bytes.fraction() - 4.0);
  std::mt19937 random(bytes.byte());
  for (Vec3& p : s.points) {
    for (double& x : p) x += amplitude * (random() * 0x1p-31 - 1.0);
  }
}

void make_infinite(TriangleSurface& s, ByteSource& bytes) {
  const int v = any_point(s, bytes);
  s.points[v].x() = bytes.byte() % 2 == 0 ? std::numeric_limits<double>::infinity()
                                          : std::numeric_limits<double>::quiet_NaN();
}

using Change = void (*)(TriangleSurface&, ByteSource&);

// The order is part of the format of the seeds: new changes go to the end.
constexpr std::array<Change, 22> changes{
    turn,  remove,   repeat,    add,          poke_hole, weld,         collapse, split,
    move,  spike,    snap,      draw,         taper,     bend,         stretch,  resize,
    shake, add_copy, shift_far, round_points, flip_edge, make_infinite};

// --- vessels ------------------------------------------------------------------------------------

std::vector<TriangleSurface> make_vessels() {
  const TriangleSurface tube = cylinder(1.0, 3.0, 8, 4);
  return {tube,
          generate_shape(Shape::bifurcation, 0.6),
          annulus(1.0, 2.0, 10, 2),
          eccentric_annulus(1.0, 0.3, 0.4, 12, 3),
          capped(tube, CapStyle::fan),
          capped(cylinder(1.0, 2.0, 16, 5), CapStyle::rings),
          cylinder(1.0, 0.2, 6, 1),
          cylinder(1.0, 3.0, 16, 8)};
}

void drop_unused_points(TriangleSurface& s) {
  std::vector<int> number(s.points.size(), -1);
  std::vector<Vec3> points;
  for (auto& triangle : s.triangles) {
    for (int& v : triangle) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(points.size());
        points.push_back(s.points[v]);
      }
      v = number[v];
    }
  }
  s.points = std::move(points);
}

}  // namespace

TriangleSurface mutated_surface(ByteSource& bytes) {
  static const std::vector<TriangleSurface> vessels = make_vessels();
  TriangleSurface surface = vessels[bytes.byte() % vessels.size()];
  for (int i = 0; i < most_changes && !bytes.empty(); ++i) {
    if (surface.triangles.empty() || surface.triangles.size() > most_triangles / 2) break;
    changes[bytes.byte() % changes.size()](surface, bytes);
  }
  drop_unused_points(surface);  // as readers do
  return surface;
}

}  // namespace hexwall::test
