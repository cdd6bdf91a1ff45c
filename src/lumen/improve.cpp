#include "lumen/improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "lumen/cell_quality.h"

namespace hexwall {
namespace {

// Faces with a cost above this are worked on; the cost of a face is about 1 at OpenFOAM's limits.
constexpr double wanted_cost = 0.25;
constexpr double limit_cosine = 0.342;  // of 70 degrees
constexpr double limit_skewness = 4.0;
constexpr double limit_weight = 0.05;
constexpr double limit_volume_ratio = 0.01;
constexpr double power = 6.0;
constexpr int most_rounds = 12;
constexpr int search_steps = 6;
constexpr double first_step = 0.15;  // of the mean length of the edges at the vertex
constexpr double invalid = 1e30;

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
    for (; result.rounds < most_rounds; ++result.rounds) {
      const std::vector<int> vertices = vertices_of_bad_faces();
      int moved = 0;
      for (const int v : vertices) moved += improve_vertex(v) ? 1 : 0;
      if (moved == 0) break;
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
    const Vec3 to_face = geometry.center - owner.center;
    const double own = geometry.area.dot(to_face);
    if (own <= 0.0) return invalid;
    if (face.neighbour < 0) {
      return std::pow(skewness_at_boundary(points.span(), geometry, owner.center) / limit_skewness,
                      power);
    }
    const CellGeometry& other = geometry_[face.neighbour];
    const double across = geometry.area.dot(other.center - geometry.center);
    if (across <= 0.0) return invalid;
    const Vec3 d = other.center - owner.center;
    const double cosine = d.dot(geometry.area) / (d.norm() * geometry.area.norm());
    const double skewness = skewness_between(points.span(), geometry, owner.center, other.center);
    const double weight = std::min(own, across) / (own + across);
    const double ratio =
        std::min(owner.volume, other.volume) / std::max(owner.volume, other.volume);
    if (ratio <= 0.0 || cosine <= 0.0) return invalid;
    return std::pow((1.0 - cosine) / (1.0 - limit_cosine), power) +
           std::pow(skewness / limit_skewness, power) + std::pow(limit_weight / weight, 4.0) +
           std::pow(limit_volume_ratio / ratio, 2.0);
  }

  std::vector<int> vertices_of_bad_faces() const {
    std::vector<char> marked(mesh_.points.size(), 0);
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      if (face_cost(f) < wanted_cost) continue;
      for (const int c : {faces_[f].owner, faces_[f].neighbour}) {
        if (c < 0) continue;
        for (const int v : mesh_.corners(c)) marked[v] = movable_[v];
      }
    }
    std::vector<int> vertices;
    for (std::size_t v = 0; v < marked.size(); ++v) {
      if (marked[v] != 0) vertices.push_back(static_cast<int>(v));
    }
    return vertices;
  }

  void update_cells(int v) {
    for (const int c : cells_of_vertex_.of(v)) {
      std::array<FaceGeometry, 6> faces;
      const std::size_t count = faces_of(mesh_.shape[c]).size();
      for (std::size_t i = 0; i < count; ++i) {
        faces[i] = face_geometry(
            FacePoints(mesh_.points, cell_face(mesh_, c, static_cast<int>(i))).span());
      }
      geometry_[c] = cell_geometry(std::span(faces).first(count));
    }
  }

  double cost_at(int v, const Vec3& place, const std::vector<int>& faces, double bound) {
    mesh_.points[v] = place;
    update_cells(v);
    double sum = 0.0;
    for (const int f : faces) {
      sum += face_cost(f);
      if (sum >= bound) break;
    }
    return sum;
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
    const Vec3 start = best_place;
    double best = cost_at(v, best_place, faces, std::numeric_limits<double>::max());
    double step = first_step * mean_edge(v);
    for (int i = 0; i < search_steps; ++i) {
      bool found = false;
      for (const Vec3& direction : directions) {
        const Vec3 place = best_place + step * direction;
        const double cost = cost_at(v, place, faces, best);
        if (cost >= best) continue;
        best = cost;
        best_place = place;
        found = true;
      }
      if (!found) step *= 0.5;
    }
    mesh_.points[v] = best_place;
    update_cells(v);
    return best_place != start;
  }

  CellMesh& mesh_;
  const std::vector<char>& movable_;
  std::vector<SharedFace> faces_;
  std::vector<CellGeometry> geometry_;
  Incidence faces_of_cell_, cells_of_vertex_;
};

}  // namespace

ImproveResult improve(CellMesh& mesh, const std::vector<char>& movable) {
  return Improver(mesh, movable).run();
}

}  // namespace hexwall
