#include "surface/orient.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/edge_uses.h"

namespace hexwall {
namespace {

// Below this fraction of area^(3/2) the enclosed volume is rounding error: single-precision
// coordinates put 1e-7 of noise on a flat surface.
constexpr double flat_volume = 1e-7;

struct Neighbour {
  int face;
  bool must_turn;  ///< both triangles traverse their common edge in the same direction
};

/// Of a triangle, over its edges with two triangles.
struct Neighbours {
  std::array<Neighbour, 3> all{};
  int count = 0;

  void add(const Neighbour& neighbour) { all[count++] = neighbour; }
  auto begin() const { return all.begin(); }
  auto end() const { return all.begin() + count; }
};

using Adjacency = std::vector<Neighbours>;

Adjacency adjacency_of(const TriangleSurface& surface) {
  Adjacency adjacency(surface.triangles.size());
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    if (last - first != 2) return;
    const EdgeUse& g = first[0];
    const EdgeUse& h = first[1];
    const bool must_turn = g.is_forward == h.is_forward;
    adjacency[g.face].add({h.face, must_turn});
    adjacency[h.face].add({g.face, must_turn});
  });
  return adjacency;
}

[[noreturn]] void refuse_mobius(const TriangleSurface& surface, int f, int g) {
  const Vec3 place = 0.5 * (centroid(surface, f) + centroid(surface, g));
  throw NotOrientable(
      fmt::format("the surface is not orientable: it contains a Moebius band, which shows between "
                  "the triangles {} and {} near {}. The wall has no inside and outside; repair the "
                  "surface there",
                  f, g, coordinates(place)),
      place);
}

/// Turns the triangles reached from `seed`, or all others of them if these are fewer.
int orient_patch(const TriangleSurface& surface, int seed, const Adjacency& adjacency,
                 std::vector<std::int8_t>& turned) {
  std::vector<int> patch{seed};
  turned[seed] = 0;
  int turned_count = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const int f = patch[i];
    for (const Neighbour& n : adjacency[f]) {
      const auto wanted = static_cast<std::int8_t>(turned[f] ^ (n.must_turn ? 1 : 0));
      if (turned[n.face] < 0) {
        turned[n.face] = wanted;
        turned_count += wanted;
        patch.push_back(n.face);
      } else if (turned[n.face] != wanted) {
        refuse_mobius(surface, f, n.face);
      }
    }
  }
  const int others = static_cast<int>(patch.size()) - turned_count;
  if (turned_count <= others) return turned_count;
  for (const int f : patch) turned[f] = static_cast<std::int8_t>(1 - turned[f]);
  return others;
}

double tetrahedron_volume(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c)) / 6.0;
}

}  // namespace

OrientResult make_consistent(const TriangleSurface& surface) {
  const Adjacency adjacency = adjacency_of(surface);
  std::vector<std::int8_t> turned(surface.triangles.size(), -1);
  OrientResult result{surface, 0};
  for (int f = 0; f < static_cast<int>(turned.size()); ++f) {
    if (turned[f] < 0) result.flipped += orient_patch(surface, f, adjacency, turned);
  }
  for (std::size_t f = 0; f < turned.size(); ++f) {
    auto& t = result.surface.triangles[f];
    if (turned[f] == 1) std::swap(t[1], t[2]);
  }
  return result;
}

double signed_volume(const TriangleSurface& surface, const Connectivity& mesh) {
  const auto& p = surface.points;
  // Sums relative to a point of the surface stay small far away from the origin.
  const Vec3 origin = surface.triangles.empty() ? Vec3(0, 0, 0) : p[surface.triangles[0][0]];
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    volume += tetrahedron_volume(p[a] - origin, p[b] - origin, p[c] - origin);
  }
  for (const std::vector<int>& loop : mesh.loops()) {
    Vec3 centroid = Vec3::Zero();
    for (const int v : loop) centroid += (p[v] - origin) / static_cast<double>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 a = p[loop[i]] - origin;
      const Vec3 b = p[loop[(i + 1) % loop.size()]] - origin;
      volume += tetrahedron_volume(b, a, centroid);
    }
  }
  return volume;
}

double signed_volume(const TriangleSurface& surface) {
  return signed_volume(surface, connectivity_of(surface));
}

OrientResult orient(const TriangleSurface& surface) {
  OrientResult result = make_consistent(surface);
  Connectivity mesh = connectivity_of(result.surface);
  wind_outward(result, mesh);
  return result;
}

void wind_outward(OrientResult& consistent, Connectivity& mesh) {
  TriangleSurface& surface = consistent.surface;
  const double scale = std::pow(total_area(surface), 1.5);
  if (signed_volume(surface, mesh) >= -flat_volume * scale) return;
  for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  consistent.flipped = static_cast<int>(surface.triangles.size()) - consistent.flipped;
  mesh = connectivity_of(surface);
}

}  // namespace hexwall
