#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "dec/delaunay.h"
#include "support/outcomes.h"
#include "support/shared_data.h"
#include "surface/check.h"
#include "surface/connectivity.h"
#include "surface/generate.h"
#include "surface/read.h"
#include "surface/triangle_surface.h"
#include "surface/vessel_tree.h"

namespace hexwall::test {

inline DelaunaySurface delaunay_of(const TriangleSurface& surface) {
  return make_delaunay(surface, connectivity_of(surface));
}

inline std::vector<double> loop_lengths(const TriangleSurface& surface, const Connectivity& mesh) {
  std::vector<double> lengths;
  for (const std::vector<int>& loop : mesh.loops()) {
    double sum = 0.0;
    for (const int v : loop) {
      sum += (surface.points[mesh.tip(mesh.outgoing(v))] - surface.points[v]).norm();
    }
    lengths.push_back(sum);
  }
  return lengths;
}

/// A trunk with five side branches of three sizes: seven loops.
inline TriangleSurface branching_tree(double edge) {
  const auto side = [](const Vec3& start, const Vec3& end, double radius) {
    const Vec3 middle = 0.5 * (start + end);
    return Branch{{start, middle, end}, {radius, radius, radius}, false, true, 0.5};
  };
  return vessel_tree({{{{0, 0, 0}, {0, 0, 5}, {0, 0, 10}}, {1.2, 1.1, 1.0}, true, true, 0.0},
                      side({0, 0, 2.5}, {4, 0, 3.5}, 0.7),
                      side({0, 0, 4.0}, {-4, 0.5, 5.5}, 0.8),
                      side({0, 0, 5.5}, {0, 4, 7.5}, 0.6),
                      side({0, 0, 6.5}, {1, -4, 7}, 0.7),
                      side({0, 0, 7.5}, {3.5, -1, 8.5}, 0.6)},
                     edge);
}

/// A trunk with `sides` side branches in a spiral around it: two loops more. With a sac too: a wide
/// blind branch along x, beyond the side branches.
inline TriangleSurface tree_with_sides(int sides, bool with_sac = false) {
  std::vector<Branch> branches;
  const double sac = 1.1 * sides + 5.0;
  const double length = with_sac ? sac + 5.0 : 1.1 * sides + 4.0;
  branches.push_back(
      {{{0, 0, 0}, {0, 0, 0.5 * length}, {0, 0, length}}, {1.2, 1.2, 1.2}, true, true, 0.0});
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.4 * i;
    const double z = 2.0 + 1.1 * i;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    branches.push_back(
        {{Vec3(0, 0, z), 2.0 * out + Vec3(0, 0, z + 0.3), 4.0 * out + Vec3(0, 0, z + 0.6)},
         {0.4, 0.4, 0.4},
         false,
         true,
         0.2});
  }
  if (with_sac) {
    branches.push_back(
        {{Vec3(0, 0, sac), Vec3(3, 0, sac), Vec3(6, 0, sac)}, {1.0, 1.2, 1.2}, false, false, 0.3});
  }
  return vessel_tree(branches, 0.2);
}

/// A straight tube with a sac on a neck on its side: a blind region by construction. Rows of the
/// tube's lattice around one place are drawn out along the normal.
inline TriangleSurface tube_with_sac() {
  TriangleSurface surface = cylinder(1.0, 10.0, 60, 90);
  const Vec3 foot(1.0, 0.0, 5.0);
  for (Vec3& p : surface.points) {
    const double angle = std::atan2(p.y(), p.x());
    const double distance = std::hypot(angle, p.z() - foot.z());
    const double reach = 0.9;
    if (distance > reach) continue;
    const double t = 1.0 - distance / reach;
    p.x() += 3.5 * t * (2.0 - t);
  }
  return surface;
}

/// Surfaces that the program can make itself, with edge lengths that keep tests quick.
inline const std::map<std::string, std::function<TriangleSurface()>>& coarse_shapes() {
  static const std::map<std::string, std::function<TriangleSurface()>> shapes{
      {"annulus", [] { return generate_shape(Shape::annulus, 0.1); }},
      {"eccentric_annulus", [] { return generate_shape(Shape::eccentric_annulus, 0.06); }},
      {"cylinder", [] { return generate_shape(Shape::cylinder, 0.25); }},
      {"bifurcation", [] { return generate_shape(Shape::bifurcation, 0.25); }},
      {"tree", [] { return branching_tree(0.3); }}};
  return shapes;
}

inline std::vector<std::string> coarse_shape_names() {
  std::vector<std::string> names;
  for (const auto& [name, shape] : coarse_shapes()) names.push_back(name);
  return names;
}

/// Names for `vessel_surface`: shapes, and the shared files that are vessel walls.
inline std::vector<std::string> vessel_surface_names() {
  std::vector<std::string> names = coarse_shape_names();
  names.emplace_back("aaa");
  for (const Outcome& file : shared_files()) {
    if (file.is_clean()) names.push_back(file.surface);
  }
  return names;
}

/// A surface by name, wound outward; null where it is a shared file that is not there. Each one is
/// made once.
inline const TriangleSurface* vessel_surface(const std::string& name) {
  static std::map<std::string, TriangleSurface> cache;
  if (const auto found = cache.find(name); found != cache.end()) return &found->second;
  if (name == "aaa") return &(cache[name] = generate_shape(Shape::aaa, 2.0));
  const auto& shapes = coarse_shapes();
  if (const auto shape = shapes.find(name); shape != shapes.end()) {
    return &(cache[name] = shape->second());
  }
  const auto folder = shared_data();
  if (!folder || !std::filesystem::exists(*folder / name)) return nullptr;
  return &(cache[name] = check_surface(read_surface(*folder / name).surface).surface);
}

/// The name of a test whose parameter is `name`.
inline std::string alphanumeric(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// The same surface with its vertices and triangles in another order; `order[i]` is the former
/// number of vertex i.
inline TriangleSurface shuffled(const TriangleSurface& surface, std::uint64_t seed,
                                std::vector<int>& order) {
  std::mt19937_64 random(seed);
  order.resize(surface.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::shuffle(order.begin(), order.end(), random);
  TriangleSurface result;
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<int>(i);
    result.points.push_back(surface.points[order[i]]);
  }
  for (const auto& [a, b, c] : surface.triangles) {
    std::array<int, 3> triangle{number[a], number[b], number[c]};
    std::rotate(triangle.begin(), triangle.begin() + static_cast<int>(random() % 3),
                triangle.end());
    result.triangles.push_back(triangle);
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

inline TriangleSurface transformed(TriangleSurface surface,
                                   const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& p : surface.points) p = map(p);
  return surface;
}

/// A rotation about no axis of the coordinate system, and a shift.
inline Vec3 rigid_motion(const Vec3& p) {
  const Eigen::AngleAxisd rotation(1.1, Vec3(1.0, -2.0, 0.5).normalized());
  return rotation * p + Vec3(3.0, -1.0, 2.0);
}

/// A tube of random radius (by a fraction `crumple`) with long, skewed and folded triangles: hard
/// for cotangent weights.
inline TriangleSurface crumpled_tube(int n_around, int n_along, double length, std::uint64_t seed,
                                     double crumple) {
  TriangleSurface surface = cylinder(1.0, length, n_around, n_along);
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53 - 0.5; };
  for (Vec3& p : surface.points) {
    if (p.z() < 1e-9 || p.z() > length - 1e-9) continue;
    const double scale = 1.0 + crumple * unit();
    p = Vec3(scale * p.x(), scale * p.y(), p.z() + 0.6 * unit() * length / n_along);
  }
  return surface;
}

}  // namespace hexwall::test
