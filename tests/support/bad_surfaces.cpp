#include "support/bad_surfaces.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "surface/generate.h"

namespace hexwall::test {
namespace {

using std::numbers::pi;

constexpr int around = 16;
constexpr int along = 6;

TriangleSurface tube() {
  return cylinder(1.0, 3.0, around, along);
}

}  // namespace

TriangleSurface closed_surface() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

TriangleSurface two_tubes() {
  TriangleSurface surface = tube();
  const int first = static_cast<int>(surface.points.size());
  const TriangleSurface other = tube();
  for (const Vec3& p : other.points) surface.points.push_back(p + Vec3(5, 0, 0));
  for (const auto& [a, b, c] : other.triangles) {
    surface.triangles.push_back({a + first, b + first, c + first});
  }
  return surface;
}

TriangleSurface one_loop() {
  TriangleSurface surface = tube();
  const int center = static_cast<int>(surface.points.size());
  surface.points.emplace_back(0, 0, 3.5);
  for (int i = 0; i < around; ++i) surface.triangles.push_back({center, i, (i + 1) % around});
  return surface;
}

TriangleSurface mobius_band() {
  TriangleSurface surface;
  const int n = 24;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * i / n;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 across = std::cos(angle / 2) * Vec3(0, 0, 1) + std::sin(angle / 2) * out;
    surface.points.push_back(2.0 * out - 0.5 * across);
    surface.points.push_back(2.0 * out + 0.5 * across);
  }
  for (int i = 0; i < n; ++i) {
    const int low = i + 1 < n ? 2 * i + 2 : 1;
    const int high = i + 1 < n ? 2 * i + 3 : 0;
    surface.triangles.push_back({2 * i, low, 2 * i + 1});
    surface.triangles.push_back({2 * i + 1, low, high});
  }
  return surface;
}

TriangleSurface tube_with_fin() {
  TriangleSurface surface = tube();
  const auto& t = surface.triangles[2 * around * along / 2];
  surface.triangles.push_back({t[0], t[1], static_cast<int>(surface.points.size())});
  surface.points.push_back(2.0 * surface.points[t[0]]);
  return surface;
}

TriangleSurface torus_with_holes() {
  TriangleSurface surface;
  const int n = 12;
  const int m = 8;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2.0 * pi * i / n;
      const double v = 2.0 * pi * j / m;
      const double r = 3.0 + std::cos(v);
      surface.points.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      if (j == 2 && (i == 2 || i == 7)) continue;  // the holes
      const int right = (i + 1) % n * m;
      const int up = (j + 1) % m;
      surface.triangles.push_back({i * m + j, right + j, right + up});
      surface.triangles.push_back({i * m + j, right + up, i * m + up});
    }
  }
  return surface;
}

TriangleSurface not_a_number() {
  TriangleSurface surface = tube();
  surface.points[3 * around].y() = std::numeric_limits<double>::quiet_NaN();
  return surface;
}

TriangleSurface self_intersecting() {
  TriangleSurface surface = tube();
  Vec3& p = surface.points[3 * around];
  p = Vec3(-2.0 * p.x(), -2.0 * p.y(), p.z());  // through the opposite side
  return surface;
}

TriangleSurface zero_area() {
  TriangleSurface surface = tube();
  surface.points[3 * around] = surface.points[3 * around + 1];
  return surface;
}

}  // namespace hexwall::test
