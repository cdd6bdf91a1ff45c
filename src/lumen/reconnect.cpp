#include "lumen/reconnect.h"

#include <algorithm>
#include <deque>
#include <limits>

#include <Eigen/Geometry>

#include "lumen/cell_cost.h"
#include "lumen/cell_quality.h"

namespace hexwall {
namespace {

using Tet = std::array<int, 4>;
using Triangle = std::array<int, 3>;

// Rings of more tetrahedra around an edge have too many ways of being filled.
constexpr std::size_t largest_ring = 7;
// A replacement has to lower the cost by this share.
constexpr double least_gain = 0.02;

constexpr std::array<Triangle, 4> faces_of_tet{{{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};

using Triangulation = std::vector<Triangle>;

/// All ways to cut the polygon of corners i … j into triangles, by the one on the side from i to j.
std::vector<Triangulation> triangulations(int i, int j) {
  if (j - i < 2) return {{}};
  std::vector<Triangulation> all;
  for (int k = i + 1; k < j; ++k) {
    const std::vector<Triangulation> right = triangulations(k, j);
    for (const Triangulation& left : triangulations(i, k)) {
      for (const Triangulation& rest : right) {
        Triangulation one = left;
        one.insert(one.end(), rest.begin(), rest.end());
        one.push_back({i, k, j});
        all.push_back(std::move(one));
      }
    }
  }
  return all;
}

class Reconnector {
 public:
  Reconnector(const CellMesh& mesh, int first) : mesh_(mesh), points_(mesh.points), first_(first) {
    geometry_ = cell_geometries(mesh);
    for (std::size_t n = 3; n <= largest_ring; ++n) {
      triangulations_[n] = triangulations(0, static_cast<int>(n) - 1);
    }
    for (int c = first; c < mesh.cells(); ++c) {
      const auto corners = mesh.corners(c);
      tets_.push_back({corners[0], corners[1], corners[2], corners[3]});
    }
    alive_.assign(tets_.size(), 1);
    cells_of_vertex_.resize(points_.size());
    for (int c = 0; c < mesh.cells(); ++c) {
      if (mesh.shape[c] == CellShape::hexahedron) continue;  // no tetrahedron borders on one
      for (const int v : mesh.corners(c)) cells_of_vertex_[v].push_back(c);
    }
  }

  std::vector<Tet> run(int& changes) {
    changes = 0;
    std::deque<int> queue = bad_tets();
    const std::size_t most = 20 * queue.size() + 100;
    for (std::size_t i = 0; i < most && !queue.empty(); ++i) {
      const int c = queue.front();
      queue.pop_front();
      if (!is_alive(c) || !is_bad(c) || !replace_around(c)) continue;
      ++changes;
      for (const int added : added_) queue.push_back(added);
    }
    std::vector<Tet> result;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      if (alive_[t] != 0) result.push_back(tets_[t]);
    }
    return result;
  }

 private:
  bool is_tet(int c) const { return c >= first_; }
  bool is_alive(int c) const { return alive_[c - first_] != 0; }
  const Tet& tet(int c) const { return tets_[c - first_]; }

  static Triangle face_of(const Tet& t, int k) {
    const Triangle& f = faces_of_tet[k];
    return {t[f[0]], t[f[1]], t[f[2]]};
  }

  std::vector<int> cells_at(std::span<const int> vertices) const {
    std::vector<int> found;
    for (const int c : cells_of_vertex_[vertices[0]]) {
      const bool has_all = std::all_of(vertices.begin() + 1, vertices.end(), [&](int v) {
        const auto& others = cells_of_vertex_[v];
        return std::find(others.begin(), others.end(), c) != others.end();
      });
      if (has_all) found.push_back(c);
    }
    return found;
  }

  // The cell on the other side of a face, -1 at the boundary.
  int across(const Triangle& face, int c) const {
    for (const int other : cells_at(face)) {
      if (other != c) return other;
    }
    return -1;
  }

  CellGeometry geometry_of(const Tet& t) const {
    std::array<FaceGeometry, 4> faces;
    for (int k = 0; k < 4; ++k) faces[k] = geometry_of(face_of(t, k));
    return cell_geometry(faces);
  }

  FaceGeometry geometry_of(const Triangle& f) const {
    return face_geometry(std::array{points_[f[0]], points_[f[1]], points_[f[2]]});
  }

  /// A face of a cavity, as the tetrahedron inside sees it, and the cell outside, -1 at the
  /// boundary.
  struct Wall {
    Triangle face;
    int outside;
  };

  double face_cost(const Triangle& f, const CellGeometry& owner, const CellGeometry* other) const {
    const std::array<Vec3, 3> corners{points_[f[0]], points_[f[1]], points_[f[2]]};
    const FaceGeometry geometry = face_geometry(corners);
    return other == nullptr ? cost::of_boundary_face(corners, geometry, owner)
                            : cost::of_face(corners, geometry, owner, *other);
  }

  static bool is_same(const Triangle& a, const Triangle& b) {
    return std::is_permutation(a.begin(), a.end(), b.begin());
  }

  // The cost of tetrahedra that fill a cavity: their faces, inside and on its walls, and
  // themselves.
  double cost_of(const std::vector<Tet>& tets, const std::vector<Wall>& walls, double bound) const {
    std::vector<CellGeometry> cells;
    for (const Tet& t : tets) {
      cells.push_back(geometry_of(t));
      if (!(cells.back().volume > 0.0)) return cost::invalid;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < tets.size() && sum < bound; ++i) {
      std::array<Vec3, 4> areas;
      std::size_t internal = 0;
      for (int k = 0; k < 4; ++k) {
        const Triangle f = face_of(tets[i], k);
        const auto wall = std::find_if(walls.begin(), walls.end(),
                                       [&](const Wall& w) { return is_same(w.face, f); });
        if (wall == walls.end()) {
          const std::size_t j = inner_neighbour(tets, i, f);
          if (j > i) sum += face_cost(f, cells[i], &cells[j]);
        } else {
          sum += face_cost(f, cells[i], wall->outside < 0 ? nullptr : &geometry_[wall->outside]);
        }
        if (wall == walls.end() || wall->outside >= 0) areas[internal++] = geometry_of(f).area;
      }
      sum += cost::of_cell(std::span(areas).first(internal));
    }
    return sum;
  }

  static std::size_t inner_neighbour(const std::vector<Tet>& tets, std::size_t i,
                                     const Triangle& f) {
    for (std::size_t j = 0; j < tets.size(); ++j) {
      if (j != i && std::all_of(f.begin(), f.end(), [&](int v) {
            return std::find(tets[j].begin(), tets[j].end(), v) != tets[j].end();
          })) {
        return j;
      }
    }
    return i;
  }

  bool is_bad(int c) const {
    std::array<Vec3, 4> areas;
    std::size_t internal = 0;
    for (int k = 0; k < 4; ++k) {
      const Triangle f = face_of(tet(c), k);
      const int other = across(f, c);
      const double of_face = face_cost(f, geometry_[c], other < 0 ? nullptr : &geometry_[other]);
      if (of_face > cost::wanted) return true;
      if (other >= 0) areas[internal++] = geometry_of(f).area;
    }
    return cost::of_cell(std::span(areas).first(internal)) > cost::wanted;
  }

  std::deque<int> bad_tets() const {
    std::vector<char> bad(mesh_.shape.size(), 0);
    const SharedFaces faces = shared_faces(mesh_);
    std::vector<std::array<Vec3, 4>> areas(tets_.size());
    std::vector<std::size_t> count(tets_.size(), 0);
    for (const SharedFace& face : faces.faces) {
      const FacePoints points(points_, face.vertices);
      const FaceGeometry geometry = face_geometry(points.span());
      const double of_face =
          face.neighbour < 0
              ? cost::of_boundary_face(points.span(), geometry, geometry_[face.owner])
              : cost::of_face(points.span(), geometry, geometry_[face.owner],
                              geometry_[face.neighbour]);
      for (const int c : {face.owner, face.neighbour}) {
        if (c < first_) continue;
        if (of_face > cost::wanted) bad[c] = 1;
        if (face.neighbour >= 0) areas[c - first_][count[c - first_]++] = geometry.area;
      }
    }
    std::deque<int> queue;
    for (int c = first_; c < mesh_.cells(); ++c) {
      const auto t = static_cast<std::size_t>(c - first_);
      if (bad[c] != 0 || cost::of_cell(std::span(areas[t]).first(count[t])) > cost::wanted) {
        queue.push_back(c);
      }
    }
    return queue;
  }

  std::vector<Wall> walls_of(const std::vector<int>& cavity) const {
    std::vector<Wall> walls;
    for (const int c : cavity) {
      for (int k = 0; k < 4; ++k) {
        const Triangle f = face_of(tet(c), k);
        const int other = across(f, c);
        if (std::find(cavity.begin(), cavity.end(), other) == cavity.end()) {
          walls.push_back({f, other});
        }
      }
    }
    return walls;
  }

  // The corners of the tetrahedra around an edge, in order around it; empty if other cells or the
  // boundary are there. Seen from b, they run counter-clockwise around a.
  std::vector<int> ring_of(int a, int b, const std::vector<int>& cells) const {
    std::vector<std::array<int, 2>> sides;
    for (const int c : cells) {
      if (!is_tet(c)) return {};
      // The two other corners u, v so that (a, b, u, v) has positive volume.
      std::array<int, 2> side{};
      int n = 0;
      for (const int v : tet(c)) {
        if (v != a && v != b) side[n++] = v;
      }
      const Vec3 u = points_[b] - points_[a];
      const double volume =
          u.cross(points_[side[0]] - points_[a]).dot(points_[side[1]] - points_[a]);
      if (volume < 0.0) std::swap(side[0], side[1]);
      sides.push_back(side);
    }
    std::vector<int> ring{sides[0][0]};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const auto next = std::find_if(sides.begin(), sides.end(), [&](const std::array<int, 2>& s) {
        return s[0] == ring.back();
      });
      if (next == sides.end()) return {};
      ring.push_back((*next)[1]);
    }
    if (ring.front() != ring.back()) return {};
    ring.pop_back();
    return ring;
  }

  void offer(std::vector<Tet> tets, const std::vector<int>& cavity, const std::vector<Wall>& walls,
             double before) {
    const double bound = std::min(best_gain_cost_ + before, before);
    const double after = cost_of(tets, walls, bound);
    if (after - before >= best_gain_cost_ || after > (1.0 - least_gain) * before) return;
    best_gain_cost_ = after - before;
    best_tets_ = std::move(tets);
    best_cavity_ = cavity;
  }

  std::vector<Tet> tets_of(const std::vector<int>& cavity) const {
    std::vector<Tet> tets;
    for (const int c : cavity) tets.push_back(tet(c));
    return tets;
  }

  void try_edge(int a, int b) {
    const std::vector<int> cavity = cells_at(std::array{a, b});
    if (cavity.size() < 3 || cavity.size() > largest_ring) return;
    const std::vector<int> ring = ring_of(a, b, cavity);
    if (ring.size() != cavity.size()) return;
    const std::vector<Wall> walls = walls_of(cavity);
    const double before = cost_of(tets_of(cavity), walls, std::numeric_limits<double>::max());
    for (const Triangulation& triangles : triangulations_[ring.size()]) {
      std::vector<Tet> tets;
      for (const auto& [i, j, k] : triangles) {
        tets.push_back({ring[i], ring[j], ring[k], b});
        tets.push_back({ring[i], ring[k], ring[j], a});
      }
      offer(std::move(tets), cavity, walls, before);
    }
  }

  // The two tetrahedra beside a face become three around the edge between their tips.
  void try_face(int c, int k) {
    const Triangle f = face_of(tet(c), k);
    const int other = across(f, c);
    if (other < first_) return;
    const auto tip = [&](int cell) {
      return *std::find_if(tet(cell).begin(), tet(cell).end(),
                           [&](int v) { return std::find(f.begin(), f.end(), v) == f.end(); });
    };
    const std::vector<int> cavity{c, other};
    const std::vector<Wall> walls = walls_of(cavity);
    const double before = cost_of(tets_of(cavity), walls, std::numeric_limits<double>::max());
    std::vector<Tet> tets;
    for (int i = 0; i < 3; ++i) {
      // The face points out of c, to the other tip.
      tets.push_back({tip(c), f[i], f[(i + 1) % 3], tip(other)});
    }
    offer(std::move(tets), cavity, walls, before);
  }

  // The best replacement of an edge or a face of a tetrahedron. \returns whether there is one.
  bool replace_around(int c) {
    best_gain_cost_ = 0.0;
    best_tets_.clear();
    const Tet t = tet(c);
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) try_edge(t[i], t[j]);
      try_face(c, i);
    }
    if (best_tets_.empty()) return false;
    for (const int old : best_cavity_) remove(old);
    added_.clear();
    for (const Tet& fresh : best_tets_) added_.push_back(add(fresh));
    return true;
  }

  void remove(int c) {
    alive_[c - first_] = 0;
    for (const int v : tet(c)) {
      auto& cells = cells_of_vertex_[v];
      cells.erase(std::find(cells.begin(), cells.end(), c));
    }
  }

  int add(const Tet& t) {
    const int c = first_ + static_cast<int>(tets_.size());
    tets_.push_back(t);
    alive_.push_back(1);
    geometry_.push_back(geometry_of(t));
    for (const int v : t) cells_of_vertex_[v].push_back(c);
    return c;
  }

  const CellMesh& mesh_;
  const std::vector<Vec3>& points_;
  int first_;
  std::vector<Tet> tets_;
  std::vector<char> alive_;
  std::vector<CellGeometry> geometry_;
  std::vector<std::vector<int>> cells_of_vertex_;
  std::array<std::vector<Triangulation>, largest_ring + 1> triangulations_;  // by corners
  double best_gain_cost_ = 0.0;
  std::vector<Tet> best_tets_;
  std::vector<int> best_cavity_;
  std::vector<int> added_;
};

}  // namespace

std::vector<std::array<int, 4>> reconnect(const CellMesh& mesh, int first, int& changes) {
  return Reconnector(mesh, first).run(changes);
}

}  // namespace hexwall
