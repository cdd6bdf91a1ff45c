#include "surface/check.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/connectivity.h"
#include "surface/edge_uses.h"
#include "surface/orient.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

constexpr std::size_t max_examples = 3;

/// Counts violations and keeps the places of the first few.
class Places {
 public:
  void add(const std::function<std::string()>& describe) {
    if (count_++ < max_examples) examples_ += (examples_.empty() ? "" : "; ") + describe();
  }
  std::size_t count() const { return count_; }
  std::string examples() const { return examples_ + (count_ > max_examples ? "; and more" : ""); }

 private:
  std::size_t count_ = 0;
  std::string examples_;
};

std::string vertex_place(const TriangleSurface& surface, int v) {
  return fmt::format("vertex {} at {}", v, coordinates(surface.points[v]));
}

std::string triangle_place(const TriangleSurface& surface, int f) {
  return fmt::format("triangle {} near {}", f, coordinates(centroid(surface, f)));
}

/// True for each vertex that a triangle uses.
std::vector<bool> used_vertices(const TriangleSurface& surface) {
  std::vector<bool> used(surface.points.size(), false);
  for (const auto& t : surface.triangles) {
    for (const int v : t) used[v] = true;
  }
  return used;
}

void check_not_empty(const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw TopologyError("the surface has no triangles");
}

void check_finite(const TriangleSurface& surface) {
  const std::vector<bool> used = used_vertices(surface);
  Places bad;
  for (int v = 0; v < static_cast<int>(used.size()); ++v) {
    if (!used[v] || surface.points[v].allFinite()) continue;
    bad.add([&] { return vertex_place(surface, v); });
  }
  if (bad.count() == 0) return;
  throw GeometryError(fmt::format(
      "{} vertices have coordinates that are not finite (NaN or infinite): {}. Export the surface "
      "again without them",
      bad.count(), bad.examples()));
}

bool has_repeated_vertex(const std::array<int, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void check_triangles(const TriangleSurface& surface) {
  Places repeated;
  Places flat;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (has_repeated_vertex(surface.triangles[f])) {
      repeated.add([&] { return triangle_place(surface, f); });
    } else if (!has_area(surface, f)) {
      flat.add([&] { return triangle_place(surface, f); });
    }
  }
  constexpr std::string_view advice =
      "Collapse their shortest edges or remesh the surface before meshing the wall";
  if (repeated.count() > 0) {
    throw GeometryError(fmt::format("{} triangles use a vertex twice and have no area: {}. {}",
                                    repeated.count(), repeated.examples(), advice));
  }
  if (flat.count() > 0) {
    throw GeometryError(
        fmt::format("{} triangles have zero area: {}. {}", flat.count(), flat.examples(), advice));
  }
}

/// Number of triangles of each connected component, in decreasing order. Components touch nowhere,
/// not even in a vertex.
std::vector<int> component_sizes(const TriangleSurface& surface) {
  std::vector<int> parent(surface.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : surface.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::vector<int> sizes(parent.size(), 0);
  for (const auto& t : surface.triangles) ++sizes[root(t[0])];
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  sizes.erase(std::find(sizes.begin(), sizes.end(), 0), sizes.end());
  return sizes;
}

void check_connected(const TriangleSurface& surface) {
  const std::vector<int> sizes = component_sizes(surface);
  if (sizes.size() == 1) return;
  std::string list;
  const std::size_t shown = std::min<std::size_t>(sizes.size(), 10);
  for (std::size_t i = 0; i < shown; ++i) list += fmt::format("{}{}", i > 0 ? ", " : "", sizes[i]);
  throw TopologyError(fmt::format(
      "the surface has {} connected components, of {}{} triangles; it has to be one. Keep only the "
      "vessel and delete the rest",
      sizes.size(), list, sizes.size() > shown ? ", ..." : ""));
}

void check_edges(const TriangleSurface& surface) {
  Places bad;
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    if (last - first <= 2) return;
    bad.add([&] {
      const Vec3 middle = 0.5 * (surface.points[first->low] + surface.points[first->high]);
      return fmt::format("edge ({}, {}) near {} has {}", first->low, first->high,
                         coordinates(middle), last - first);
    });
  });
  if (bad.count() == 0) return;
  throw TopologyError(fmt::format(
      "the surface is not manifold: {} edges have more than two triangles: {}. Delete the inner "
      "walls or doubled triangles there",
      bad.count(), bad.examples()));
}

/// Number of fans of edge-connected triangles at each vertex.
std::vector<int> fan_counts(const TriangleSurface& surface) {
  const int corner_count = 3 * static_cast<int>(surface.triangles.size());
  std::vector<int> parent(corner_count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto corner = [&](int f, int v) {
    const auto& t = surface.triangles[f];
    return 3 * f + static_cast<int>(std::find(t.begin(), t.end(), v) - t.begin());
  };
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    for (auto use = first + 1; use != last; ++use) {
      for (const int v : {first->low, first->high}) {
        parent[root(corner(use->face, v))] = root(corner(first->face, v));
      }
    }
  });
  std::vector<int> fans(surface.points.size(), 0);
  for (int c = 0; c < corner_count; ++c) {
    if (parent[c] == c) ++fans[surface.triangles[c / 3][c % 3]];
  }
  return fans;
}

void check_vertices(const TriangleSurface& surface) {
  const std::vector<int> fans = fan_counts(surface);
  Places bad;
  for (int v = 0; v < static_cast<int>(fans.size()); ++v) {
    if (fans[v] > 1) bad.add([&] { return vertex_place(surface, v); });
  }
  if (bad.count() == 0) return;
  throw TopologyError(fmt::format(
      "the surface is not manifold: at {} vertices two or more parts touch in a single point: {}. "
      "Separate the parts there or delete the smaller one",
      bad.count(), bad.examples()));
}

void check_loops(const Connectivity& mesh) {
  const std::size_t loops = mesh.loops().size();
  if (loops >= 2) return;
  if (loops == 0) {
    throw TopologyError(
        "the surface is closed: it has no boundary loops. Cut its caps off at the vessel's inlets "
        "and outlets, which leaves one loop for each (at least 2)");
  }
  throw TopologyError(
      "the surface has only one boundary loop; a vessel needs at least 2, one for each inlet and "
      "outlet. Cut off the caps that still close it");
}

// A sphere with g handles and b holes has the Euler number 2 - 2 g - b.
void check_genus(const Connectivity& mesh) {
  const int genus = (2 - static_cast<int>(mesh.loops().size()) - mesh.euler_number()) / 2;
  if (genus == 0) return;
  throw TopologyError(fmt::format(
      "the surface has genus {0}: it has {0} handles, as where two branches fuse or touch. Only "
      "spheres with holes (genus 0) can be meshed; cut the handles open and close the cuts",
      genus));
}

void check_self_intersections(const TriangleSurface& surface) {
  const auto pairs = self_intersections(surface);
  if (pairs.empty()) return;
  Places bad;
  for (const auto& [f, g] : pairs) {
    bad.add([&surface, f = f, g = g] {
      return fmt::format("triangles {} and {} near {}", f, g, coordinates(centroid(surface, f)));
    });
  }
  throw GeometryError(fmt::format(
      "the surface has a self-intersection: {} pairs of triangles cross or touch: {}. Smooth or "
      "remesh the surface there",
      bad.count(), bad.examples()));
}

void note_winding(CheckResult& result) {
  if (result.flipped == 0) return;
  if (result.flipped == static_cast<int>(result.surface.triangles.size())) {
    result.notes.emplace_back("all triangles were wound inward and were turned");
  } else {
    result.notes.push_back(
        fmt::format("{} triangles had the wrong winding and were turned", result.flipped));
  }
}

}  // namespace

CheckResult check_surface(const TriangleSurface& surface, bool is_free_of_intersections) {
  check_not_empty(surface);
  check_finite(surface);
  check_triangles(surface);
  check_connected(surface);
  check_edges(surface);
  make_consistent(surface);  // a Möbius band is reported before touching parts are
  check_vertices(surface);
  OrientResult oriented = orient(surface);
  const Connectivity mesh(static_cast<int>(surface.points.size()), oriented.surface.triangles);
  check_loops(mesh);
  check_genus(mesh);
  if (!is_free_of_intersections) check_self_intersections(oriented.surface);
  CheckResult result{std::move(oriented.surface), oriented.flipped, {}};
  note_winding(result);
  return result;
}

}  // namespace hexwall
