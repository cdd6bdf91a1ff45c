#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "surface/connectivity.h"
#include "surface/counted.h"
#include "surface/repair_steps.h"

namespace hexwall::repair {
namespace {

// A hole of one vertex and its six triangles has 6 edges, the smallest openings that vessels come
// with have 8 or 9.
constexpr double pinhole_edges = 8.0;
constexpr double pinhole_loop_ratio = 0.02;   // in fine triangulations: of the longest loop
constexpr double greatest_loop_ratio = 0.25;  // in coarse ones no more than this
// The longest loop of a surface with closed ends may be a pinhole itself. Loops of vessels are
// rarely shorter than this fraction of the square root of the area.
constexpr double usual_loop = 0.25;
// Mean cosine between the surface and the plane of the hole: 1 in a smooth wall, 0 at a tube's end.
constexpr double least_cosine = 0.5;
// Area vector over perimeter squared; a circle has 0.08, a slit next to nothing.
constexpr double slit_area = 1e-3;

// Among patches of equal area, as in a plane, short edges make the better triangles.
constexpr double edge_weight = 1e-2;

using Loop = std::vector<int>;

struct Shape {
  double perimeter = 0.0;
  Vec3 doubled_area = Vec3::Zero();  // outward for a hole in a wall
};

Shape shape_of(const std::vector<Vec3>& points, const Loop& loop) {
  Shape shape;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& p = points[loop[i]];
    const Vec3& q = points[loop[(i + 1) % loop.size()]];
    shape.perimeter += (q - p).norm();
    // Loops have the surface on their left, the hole on their right.
    shape.doubled_area += (q - points[loop[0]]).cross(p - points[loop[0]]);
  }
  return shape;
}

bool lies_in_wall(const TriangleSurface& surface, const Connectivity& mesh, const Loop& loop,
                  const Shape& shape) {
  if (shape.doubled_area.norm() < slit_area * shape.perimeter * shape.perimeter) return true;
  double cosine = 0.0;
  for (const int v : loop) {
    const Vec3 normal = doubled_area_vector(surface, Connectivity::face(mesh.outgoing(v)));
    cosine += normal.normalized().dot(shape.doubled_area.normalized());
  }
  return cosine > least_cosine * static_cast<double>(loop.size());
}

std::vector<Loop> find_pinholes(const TriangleSurface& surface, const Connectivity& mesh,
                                const double* length) {
  std::vector<Shape> shapes;
  double longest = usual_loop * std::sqrt(total_area(surface));
  for (const Loop& loop : mesh.loops()) {
    shapes.push_back(shape_of(surface.points, loop));
    longest = std::max(longest, shapes.back().perimeter);
  }
  const double by_edges = pinhole_edges * mean_edge_length(surface);
  const double limit =
      std::min(std::max(by_edges, pinhole_loop_ratio * longest), greatest_loop_ratio * longest);
  std::vector<Loop> result;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Loop& loop = mesh.loops()[i];
    const bool is_pinhole = length != nullptr ? shapes[i].perimeter < *length
                                              : shapes[i].perimeter < limit &&
                                                    lies_in_wall(surface, mesh, loop, shapes[i]);
    if (is_pinhole) result.push_back(loop);
  }
  return result;
}

/// Triangulates a closed polygon with the least area, by dynamic programming over its chords.
/// O(n³). Chords that are edges of the surface already are not used.
class Patch {
 public:
  Patch(const TriangleSurface& surface, const Connectivity& mesh, const Loop& loop)
      : points_(surface.points), loop_(loop), size_(static_cast<int>(loop.size())) {
    const std::set<int> members(loop.begin(), loop.end());
    for (const int v : loop) {
      for (int h = mesh.outgoing(v); h >= 0; h = mesh.rotate(h)) {
        for (const int w : {mesh.tip(h), mesh.apex(h)}) {
          if (members.count(w) > 0) edges_.insert(std::minmax(v, w));
        }
      }
    }
    cost_.assign(size_ * size_, 0.0);
    split_.assign(size_ * size_, -1);
  }

  /// Nothing if every triangulation needs an edge that is there already.
  std::optional<std::vector<std::array<int, 3>>> triangles() {
    for (int span = 2; span < size_; ++span) {
      for (int i = 0; i + span < size_; ++i) solve(i, i + span);
    }
    if (cost_[size_ - 1] == std::numeric_limits<double>::infinity()) return std::nullopt;
    std::vector<std::array<int, 3>> result;
    collect(0, size_ - 1, result);
    return result;
  }

 private:
  const Vec3& point(int i) const { return points_[loop_[i]]; }

  void solve(int i, int k) {
    double& best = cost_[i * size_ + k];
    best = std::numeric_limits<double>::infinity();
    const bool is_side = i == 0 && k == size_ - 1;
    if (!is_side && edges_.count(std::minmax(loop_[i], loop_[k])) > 0) return;
    const double edge = is_side ? 0.0 : edge_weight * (point(k) - point(i)).squaredNorm();
    for (int j = i + 1; j < k; ++j) {
      const double area = 0.5 * (point(j) - point(i)).cross(point(k) - point(i)).norm();
      const double cost = cost_[i * size_ + j] + cost_[j * size_ + k] + area + edge;
      if (cost >= best) continue;
      best = cost;
      split_[i * size_ + k] = j;
    }
  }

  // The loop has the surface on its left, so that the patch goes round it the other way.
  void collect(int i, int k, std::vector<std::array<int, 3>>& result) const {
    if (k - i < 2) return;
    const int j = split_[i * size_ + k];
    result.push_back({loop_[k], loop_[j], loop_[i]});
    collect(i, j, result);
    collect(j, k, result);
  }

  const std::vector<Vec3>& points_;
  const Loop& loop_;
  int size_;
  std::set<std::pair<int, int>> edges_;
  std::vector<double> cost_;
  std::vector<int> split_;
};

Vec3 center_of(const std::vector<Vec3>& points, const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const int v : loop) sum += points[v];
  return sum / static_cast<double>(loop.size());
}

}  // namespace

Outcome fill_pinholes(State& state, const Connectivity& mesh, const double* length) {
  Outcome outcome;
  int added = 0;
  for (const Loop& loop : find_pinholes(state.surface, mesh, length)) {
    const auto patch = Patch(state.surface, mesh, loop).triangles();
    if (!patch) continue;
    for (const auto& t : *patch) {
      state.surface.triangles.push_back(t);
      state.origin.push_back(-1);
    }
    added += static_cast<int>(patch->size());
    outcome.places.push_back(center_of(state.surface.points, loop));
  }
  outcome.text = fmt::format("{} filled with {}",
                             counted(outcome.places.size(), "small hole was", "small holes were"),
                             counted(added, "triangle"));
  return outcome;
}

}  // namespace hexwall::repair
