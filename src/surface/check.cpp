#include "surface/check.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel.h"
#include "surface/counted.h"
#include "surface/edge_uses.h"
#include "surface/handles.h"
#include "surface/orient.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

constexpr std::size_t max_examples = 3;

/// Where something is wrong: all places, and the first few in words.
class Places {
 public:
  void add(const Vec3& at, const std::function<std::string()>& describe) {
    if (places_.size() < max_examples) examples_ += (examples_.empty() ? "" : "; ") + describe();
    places_.push_back(at);
  }
  std::size_t count() const { return places_.size(); }
  std::string examples() const {
    return examples_ + (places_.size() > max_examples ? "; and more" : "");
  }
  std::vector<Vec3> all() const { return places_; }

 private:
  std::vector<Vec3> places_;
  std::string examples_;
};

using Problems = std::vector<Problem>;

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

void check_not_empty(const TriangleSurface& surface, Problems& problems) {
  if (!surface.triangles.empty()) return;
  problems.push_back({"empty", ExitCode::topology, "the surface has no triangles", {}});
}

void check_finite(const TriangleSurface& surface, Problems& problems) {
  const std::vector<bool> used = used_vertices(surface);
  Places bad;
  for (int v = 0; v < static_cast<int>(used.size()); ++v) {
    if (!used[v] || surface.points[v].allFinite()) continue;
    bad.add(surface.points[v], [&] { return vertex_place(surface, v); });
  }
  if (bad.count() == 0) return;
  problems.push_back(
      {"not_finite",
       ExitCode::geometry,
       fmt::format("{} coordinates that are not finite (NaN or "
                   "infinite): {}. Export the surface again without them",
                   counted(bad.count(), "vertex has", "vertices have"), bad.examples()),
       {}});
}

bool has_repeated_vertex(const std::array<int, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void check_triangles(const TriangleSurface& surface, Problems& problems) {
  Places repeated;
  Places flat;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    if (has_repeated_vertex(surface.triangles[f])) {
      repeated.add(centroid(surface, f), [&] { return triangle_place(surface, f); });
    } else if (!has_area(surface, f)) {
      flat.add(centroid(surface, f), [&] { return triangle_place(surface, f); });
    }
  }
  constexpr std::string_view advice =
      "Collapse their shortest edges or remesh the surface before meshing the wall";
  if (repeated.count() > 0) {
    problems.push_back({"degenerate", ExitCode::geometry,
                        fmt::format("{} a vertex twice, without area: {}. {}",
                                    counted(repeated.count(), "triangle uses", "triangles use"),
                                    repeated.examples(), advice),
                        repeated.all()});
  }
  if (flat.count() > 0) {
    problems.push_back({"degenerate", ExitCode::geometry,
                        fmt::format("{} zero area: {}. {}",
                                    counted(flat.count(), "triangle has", "triangles have"),
                                    flat.examples(), advice),
                        flat.all()});
  }
}

struct Component {
  int triangles;
  int first;  ///< its triangle of lowest number
};

/// Connected components, the one of most triangles first. They touch nowhere, not even in a vertex.
std::vector<Component> components(const TriangleSurface& surface) {
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
  std::vector<int> number(parent.size(), -1);
  std::vector<Component> found;
  for (int f = 0; f < static_cast<int>(surface.triangles.size()); ++f) {
    int& n = number[root(surface.triangles[f][0])];
    if (n < 0) {
      n = static_cast<int>(found.size());
      found.push_back({0, f});
    }
    ++found[n].triangles;
  }
  std::stable_sort(found.begin(), found.end(), [](const Component& l, const Component& r) {
    return l.triangles > r.triangles;
  });
  return found;
}

void check_connected(const TriangleSurface& surface, Problems& problems) {
  const std::vector<Component> found = components(surface);
  if (found.size() == 1) return;
  std::string list;
  std::vector<Vec3> places;
  const std::size_t shown = std::min<std::size_t>(found.size(), 10);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i < shown) list += fmt::format("{}{}", i > 0 ? ", " : "", found[i].triangles);
    if (i > 0) places.push_back(centroid(surface, found[i].first));
  }
  problems.push_back({"components", ExitCode::topology,
                      fmt::format("the surface has {} connected components, of {}{} triangles; it "
                                  "has to be one. Keep only the vessel and delete the rest",
                                  found.size(), list, found.size() > shown ? ", ..." : ""),
                      places});
}

void check_edges(const TriangleSurface& surface, Problems& problems) {
  Places bad;
  for_each_edge(edge_uses(surface.triangles), [&](auto first, auto last) {
    if (last - first <= 2) return;
    const Vec3 middle = 0.5 * (surface.points[first->low] + surface.points[first->high]);
    bad.add(middle, [&] {
      return fmt::format("edge ({}, {}) near {} has {}", first->low, first->high,
                         coordinates(middle), last - first);
    });
  });
  if (bad.count() == 0) return;
  problems.push_back(
      {"nonmanifold_edges", ExitCode::topology,
       fmt::format("the surface is not manifold: {} more than two "
                   "triangles: {}. Delete the inner walls or doubled triangles there",
                   counted(bad.count(), "edge has", "edges have"), bad.examples()),
       bad.all()});
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

void check_vertices(const TriangleSurface& surface, Problems& problems) {
  const std::vector<int> fans = fan_counts(surface);
  Places bad;
  for (int v = 0; v < static_cast<int>(fans.size()); ++v) {
    if (fans[v] > 1) bad.add(surface.points[v], [&] { return vertex_place(surface, v); });
  }
  if (bad.count() == 0) return;
  problems.push_back(
      {"nonmanifold_vertices", ExitCode::topology,
       fmt::format("the surface is not manifold: at {} two or more parts touch in a single "
                   "point: {}. Separate the parts there or delete the smaller one",
                   counted(bad.count(), "vertex", "vertices"), bad.examples()),
       bad.all()});
}

/// A Möbius band is reported before touching parts are. \param consistent the surface if it is
/// none.
void check_orientable(const TriangleSurface& surface, OrientResult& consistent,
                      Problems& problems) {
  try {
    consistent = make_consistent(surface);
  } catch (const NotOrientable& error) {
    problems.push_back({"not_orientable", error.code(), error.what(), {error.place()}});
  }
}

void check_loops(const Connectivity& mesh, const TriangleSurface& surface, Problems& problems) {
  const std::size_t loops = mesh.loops().size();
  if (loops >= 2) return;
  if (loops == 0) {
    problems.push_back(
        {"closed",
         ExitCode::topology,
         "the surface is closed: it has no boundary loops. Cut its caps off at the vessel's inlets "
         "and outlets, which leaves one loop for each (at least 2)",
         {}});
    return;
  }
  problems.push_back(
      {"closed",
       ExitCode::topology,
       "the surface has only one boundary loop; a vessel needs at least 2, one for each inlet and "
       "outlet. Cut off the caps that still close it",
       {surface.points[mesh.loops()[0].front()]}});
}

// A sphere with g handles and b holes has the Euler number 2 - 2 g - b.
void check_genus(const Connectivity& mesh, const TriangleSurface& surface, Problems& problems) {
  const int genus = (2 - static_cast<int>(mesh.loops().size()) - mesh.euler_number()) / 2;
  if (genus == 0) return;
  std::vector<Vec3> line;
  Vec3 middle = Vec3::Zero();
  for (const int v : handle_line(surface, mesh)) line.push_back(surface.points[v]);
  for (const Vec3& p : line) middle += p / static_cast<double>(line.size());
  problems.push_back(
      {"genus", ExitCode::topology,
       fmt::format("the surface has genus {}: it has {}, as where two branches fuse or "
                   "touch, {} near {}. Only spheres with holes (genus 0) can be meshed; "
                   "cut the handles open and close the cuts",
                   genus, counted(genus, "handle"), genus == 1 ? "here" : "one of them",
                   coordinates(middle)),
       std::move(line)});
}

void check_self_intersections(const TriangleSurface& surface, Problems& problems) {
  const auto pairs = self_intersections(surface);
  if (pairs.empty()) return;
  Places bad;
  for (const auto& [f, g] : pairs) {
    bad.add(centroid(surface, f), [&surface, f = f, g = g] {
      return fmt::format("triangles {} and {} near {}", f, g, coordinates(centroid(surface, f)));
    });
  }
  problems.push_back(
      {"self_intersections", ExitCode::geometry,
       fmt::format(
           "the surface has a self-intersection: {}: {}. Smooth or remesh the surface there",
           counted(bad.count(), "pair of triangles crosses or touches",
                   "pairs of triangles cross or touch"),
           bad.examples()),
       bad.all()});
}

void note_winding(CheckResult& result) {
  if (result.flipped == 0) return;
  if (result.flipped == static_cast<int>(result.surface.triangles.size())) {
    result.notes.emplace_back("all triangles were wound inward and were turned");
  } else {
    result.notes.push_back(counted(result.flipped, "triangle had the wrong winding and was turned",
                                   "triangles had the wrong winding and were turned"));
  }
}

using Check = std::function<void(Problems&)>;

// Runs checks that do not depend on each other side by side.
void run_group(const std::vector<Check>& checks, Problems& problems) {
  std::vector<Problems> found(checks.size());
  parallel_tasks(checks.size(), [&](std::size_t i) { checks[i](found[i]); });
  for (Problems& some : found) {
    problems.insert(problems.end(), std::make_move_iterator(some.begin()),
                    std::make_move_iterator(some.end()));
  }
}

// Groups of checks presuppose that those before them passed.
Problems run_checks(const TriangleSurface& surface, bool is_free_of_intersections,
                    OrientResult& oriented, Connectivity& mesh) {
  Problems problems;
  check_not_empty(surface, problems);
  if (problems.empty()) check_finite(surface, problems);
  if (!problems.empty()) return problems;
  run_group({[&](Problems& p) { check_triangles(surface, p); },
             [&](Problems& p) { check_connected(surface, p); },
             [&](Problems& p) { check_edges(surface, p); },
             [&](Problems& p) { check_orientable(surface, oriented, p); },
             [&](Problems& p) { check_vertices(surface, p); }},
            problems);
  if (!problems.empty()) return problems;
  mesh = connectivity_of(oriented.surface);
  wind_outward(oriented, mesh);
  run_group({[&](Problems& p) { check_loops(mesh, surface, p); },
             [&](Problems& p) { check_genus(mesh, oriented.surface, p); },
             [&](Problems& p) {
               if (!is_free_of_intersections) check_self_intersections(oriented.surface, p);
             }},
            problems);
  return problems;
}

}  // namespace

std::vector<Problem> find_problems(const TriangleSurface& surface) {
  OrientResult oriented;
  Connectivity mesh;
  return run_checks(surface, false, oriented, mesh);
}

CheckResult check_surface(const TriangleSurface& surface, bool is_free_of_intersections) {
  OrientResult oriented;
  Connectivity mesh;
  const Problems problems = run_checks(surface, is_free_of_intersections, oriented, mesh);
  if (!problems.empty()) {
    const Problem& first = problems.front();
    if (first.code == ExitCode::geometry) throw GeometryError(first.message);
    throw TopologyError(first.message);
  }
  CheckResult result{std::move(oriented.surface), std::move(mesh), oriented.flipped, {}};
  note_winding(result);
  return result;
}

}  // namespace hexwall
