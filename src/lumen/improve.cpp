#include "lumen/improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "lumen/cell_cost.h"
#include "lumen/cell_quality.h"

namespace hexwall {
namespace {

constexpr int most_rounds = 12;
constexpr int search_steps = 6;
constexpr double good_enough = 0.7;  // of the wanted cost: a vertex need not move further
constexpr double least_gain = 0.01;  // less is no reason to look at a vertex again
constexpr double first_step = 0.15;  // of the mean length of the edges at the vertex

struct Incidence {
  std::vector<int> begin;
  std::vector<int> items;

  std::span<const int> of(int i) const {
    return {items.data() + begin[i], items.data() + begin[i + 1]};
  }
};

/// Lists of what belongs to each of `count` things, of pairs (thing, item).
Incidence group(int count, const std::vector<std::pair<int, int>>& pairs) {
  Incidence result{std::vector<int>(static_cast<std::size_t>(count) + 1, 0),
                   std::vector<int>(pairs.size())};
  for (const auto& pair : pairs) ++result.begin[pair.first + 1];
  for (int i = 0; i < count; ++i) result.begin[i + 1] += result.begin[i];
  std::vector<int> next = result.begin;
  for (const auto& [thing, item] : pairs) result.items[next[thing]++] = item;
  return result;
}

class Improver {
 public:
  Improver(CellMesh& mesh, const std::vector<char>& movable)
      : mesh_(mesh), movable_(movable), faces_(shared_faces(mesh).faces) {
    geometry_ = cell_geometries(mesh);
    std::vector<std::pair<int, int>> pairs;
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      pairs.emplace_back(faces_[f].owner, f);
      if (faces_[f].neighbour >= 0) pairs.emplace_back(faces_[f].neighbour, f);
    }
    faces_of_cell_ = group(mesh.cells(), pairs);
    pairs.clear();
    for (int c = 0; c < mesh.cells(); ++c) {
      for (const int v : mesh.corners(c)) {
        if (movable[v] != 0) pairs.emplace_back(v, c);
      }
    }
    cells_of_vertex_ = group(static_cast<int>(mesh.points.size()), pairs);
  }

  ImproveResult run() {
    const std::vector<Vec3> before = mesh_.points;
    ImproveResult result;
    std::vector<int> vertices = vertices_of(bad_faces(), bad_cells());
    for (; result.rounds < most_rounds && !vertices.empty(); ++result.rounds) {
      improve_vertices(vertices);
      vertices = bad_around(vertices);
    }
    for (std::size_t v = 0; v < before.size(); ++v) {
      if (before[v] != mesh_.points[v]) ++result.moved;
    }
    return result;
  }

 private:
  double face_cost(int f) const {
    const SharedFace& face = faces_[f];
    const FacePoints points(mesh_.points, face.vertices);
    const FaceGeometry geometry = face_geometry(points.span());
    const CellGeometry& owner = geometry_[face.owner];
    return face.neighbour < 0
               ? cost::of_boundary_face(points.span(), geometry, owner)
               : cost::of_face(points.span(), geometry, owner, geometry_[face.neighbour]);
  }

  double cell_cost(int c) const {
    std::array<Vec3, 6> areas;
    std::size_t count = 0;
    for (const int f : faces_of_cell_.of(c)) {
      if (faces_[f].neighbour < 0) continue;
      areas[count++] = face_geometry(FacePoints(mesh_.points, faces_[f].vertices).span()).area;
    }
    const double cost = cost::of_cell(std::span(areas).first(count));
    return mesh_.shape[c] == CellShape::pyramid ? cost + depth_cost(c) : cost;
  }

  double depth_cost(int pyramid) const {
    std::array<FaceGeometry, 5> faces;
    for (int i = 0; i < 5; ++i) {
      faces[i] = face_geometry(FacePoints(mesh_.points, cell_face(mesh_, pyramid, i)).span());
    }
    return cost::of_depth(faces);
  }

  void mark(int c, std::vector<char>& marked) const {
    for (const int v : mesh_.corners(c)) {
      if (movable_[v] != 0) marked[v] = 1;
    }
  }

  bool is_movable(int c) const {
    const auto corners = mesh_.corners(c);
    return std::any_of(corners.begin(), corners.end(), [&](int v) { return movable_[v] != 0; });
  }

  template <typename IsBad>
  static std::vector<int> numbers_where(std::size_t count, const IsBad& is_bad) {
    std::vector<char> bad(count);
    parallel_for(count, [&](std::size_t i) { bad[i] = is_bad(static_cast<int>(i)) ? 1 : 0; });
    std::vector<int> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      if (bad[i] != 0) numbers.push_back(static_cast<int>(i));
    }
    return numbers;
  }

  std::vector<int> bad_faces() const {
    return numbers_where(faces_.size(), [&](int f) { return face_cost(f) > cost::wanted; });
  }

  std::vector<int> bad_cells() const {
    return numbers_where(mesh_.shape.size(),
                         [&](int c) { return is_movable(c) && cell_cost(c) > cost::wanted; });
  }

  // Movable vertices of cells, and of the cells beside faces.
  std::vector<int> vertices_of(const std::vector<int>& faces, const std::vector<int>& cells) const {
    std::vector<char> marked(mesh_.points.size(), 0);
    for (const int f : faces) {
      mark(faces_[f].owner, marked);
      if (faces_[f].neighbour >= 0) mark(faces_[f].neighbour, marked);
    }
    for (const int c : cells) mark(c, marked);
    return numbers_where(marked.size(), [&](int v) { return marked[v] != 0; });
  }

  // Vertices that gained by moving, and around which there is something bad still, with those of
  // the cells there.
  std::vector<int> bad_around(const std::vector<int>& vertices) const {
    std::vector<int> faces;
    std::vector<int> cells;
    for (const int v : vertices) {
      if (has_gained_[v] == 0) continue;
      for (const int f : faces_around(v)) {
        if (face_cost(f) > cost::wanted) faces.push_back(f);
      }
      for (const int c : cells_of_vertex_.of(v)) {
        if (cell_cost(c) > cost::wanted) cells.push_back(c);
      }
    }
    return vertices_of(faces, cells);
  }

  // All at a time that do not see each other move: the result is the same on any number of threads.
  void improve_vertices(std::vector<int> vertices) {
    has_gained_.assign(mesh_.points.size(), 0);
    std::vector<int> taken(mesh_.shape.size(), -1);
    for (int batch = 0; !vertices.empty(); ++batch) {
      std::vector<int> now;
      std::vector<int> later;
      for (const int v : vertices) (take(v, batch, taken) ? now : later).push_back(v);
      parallel_tasks(now.size(),
                     [&](std::size_t i) { has_gained_[now[i]] = improve_vertex(now[i]) ? 1 : 0; });
      vertices = std::move(later);
    }
  }

  // Takes the cells of a vertex unless one of them borders on a cell that is taken.
  bool take(int v, int batch, std::vector<int>& taken) const {
    for (const int f : faces_around(v)) {
      for (const int c : {faces_[f].owner, faces_[f].neighbour}) {
        if (c >= 0 && taken[c] == batch) return false;
      }
    }
    for (const int c : cells_of_vertex_.of(v)) taken[c] = batch;
    return true;
  }

  CellGeometry geometry_of(int c) const {
    const auto corners = mesh_.corners(c);
    if (mesh_.shape[c] == CellShape::tetrahedron) {
      const Vec3& o = mesh_.points[corners[0]];
      const Vec3 a = mesh_.points[corners[1]] - o;
      const Vec3 b = mesh_.points[corners[2]] - o;
      const Vec3 d = mesh_.points[corners[3]] - o;
      return {o + 0.25 * (a + b + d), a.cross(b).dot(d) / 6.0};
    }
    std::array<FaceGeometry, 6> faces;
    const std::size_t count = faces_of(mesh_.shape[c]).size();
    for (std::size_t i = 0; i < count; ++i) {
      faces[i] =
          face_geometry(FacePoints(mesh_.points, cell_face(mesh_, c, static_cast<int>(i))).span());
    }
    return cell_geometry(std::span(faces).first(count));
  }

  void move_to(int v, const Vec3& place) {
    mesh_.points[v] = place;
    for (const int c : cells_of_vertex_.of(v)) geometry_[c] = geometry_of(c);
  }

  struct Cost {
    double sum = 0.0;
    double worst = 0.0;

    void add(double more) {
      sum += more;
      worst = std::max(worst, more);
    }
  };

  // Of what moves with a vertex; of a part if that reaches the bound.
  Cost cost_around(int v, const std::vector<int>& faces, double bound) const {
    Cost result;
    for (const int f : faces) {
      result.add(face_cost(f));
      if (result.sum >= bound) return result;
    }
    for (const int c : cells_of_vertex_.of(v)) result.add(cell_cost(c));
    return result;
  }

  std::vector<int> faces_around(int v) const {
    std::vector<int> faces;
    for (const int c : cells_of_vertex_.of(v)) {
      const auto of_cell = faces_of_cell_.of(c);
      faces.insert(faces.end(), of_cell.begin(), of_cell.end());
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  double mean_edge(int v) const {
    double sum = 0.0;
    double count = 0.0;
    for (const int c : cells_of_vertex_.of(v)) {
      for (const int w : mesh_.corners(c)) {
        if (w == v) continue;
        sum += (mesh_.points[w] - mesh_.points[v]).norm();
        count += 1.0;
      }
    }
    return sum / count;
  }

  // Pattern search along the axes and diagonals.
  bool improve_vertex(int v) {
    static const std::array<Vec3, 14> directions{
        Vec3{1, 0, 0},  Vec3{-1, 0, 0},  Vec3{0, 1, 0},    Vec3{0, -1, 0}, Vec3{0, 0, 1},
        Vec3{0, 0, -1}, Vec3{1, 1, 1},   Vec3{-1, -1, -1}, Vec3{-1, 1, 1}, Vec3{1, -1, -1},
        Vec3{1, -1, 1}, Vec3{-1, 1, -1}, Vec3{1, 1, -1},   Vec3{-1, -1, 1}};
    const std::vector<int> faces = faces_around(v);
    Vec3 best_place = mesh_.points[v];
    Cost best = cost_around(v, faces, std::numeric_limits<double>::max());
    const double before = best.sum;
    double step = first_step * mean_edge(v);
    for (int i = 0; i < search_steps && best.worst > good_enough * cost::wanted; ++i) {
      bool found = false;
      for (const Vec3& direction : directions) {
        const Vec3 place = best_place + step * direction;
        move_to(v, place);
        const Cost candidate = cost_around(v, faces, best.sum);
        if (candidate.sum >= best.sum) continue;
        best = candidate;
        best_place = place;
        found = true;
      }
      if (!found) step *= 0.5;
    }
    move_to(v, best_place);
    return best.sum < (1.0 - least_gain) * before;
  }

  CellMesh& mesh_;
  const std::vector<char>& movable_;
  std::vector<SharedFace> faces_;
  std::vector<CellGeometry> geometry_;
  Incidence faces_of_cell_, cells_of_vertex_;
  std::vector<char> has_gained_;  // #V in the last round
};

}  // namespace

ImproveResult improve(CellMesh& mesh, const std::vector<char>& movable) {
  return Improver(mesh, movable).run();
}

}  // namespace hexwall
