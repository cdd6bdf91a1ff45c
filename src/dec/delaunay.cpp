#include "dec/delaunay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "core/tolerances.h"
#include "surface/connectivity.h"

namespace hexwall {
namespace {

// Half-edge mesh that can split and flip: half-edge 3 f + k as in Connectivity.
class Refiner {
 public:
  explicit Refiner(const TriangleSurface& input)
      : points_(input.points), triangles_(input.triangles), parent_(input.triangles.size()) {
    const Connectivity mesh(static_cast<int>(points_.size()), triangles_);
    twin_.resize(mesh.halfedge_count());
    for (int h = 0; h < mesh.halfedge_count(); ++h) twin_[h] = mesh.twin(h);
    for (std::size_t f = 0; f < parent_.size(); ++f) parent_[f] = static_cast<int>(f);
    loop_.resize(points_.size());
    for (int v = 0; v < mesh.vertex_count(); ++v) loop_[v] = mesh.loop_of_vertex(v);
    // Segmented surfaces need less than four splits a vertex; the floor is for coarse surfaces of
    // long triangles, which take hundreds. Past this the input is hopeless and the caller is told.
    split_budget_ = std::max<std::size_t>(8 * points_.size(), 100000);
  }

  DelaunaySurface run() {
    split_chords();
    for (int h = 0; h < static_cast<int>(twin_.size()); ++h) push(h);
    while (!queue_.empty()) {
      const int h = queue_.back();
      queue_.pop_back();
      queued_[h] = false;
      if (twin_[h] >= 0 && cotangent_sum(h) < -tolerance::delaunay_cotangent) improve(h);
    }
    return result();
  }

 private:
  static int next(int h) { return Connectivity::next(h); }
  static int prev(int h) { return Connectivity::prev(h); }
  int tail(int h) const { return triangles_[h / 3][h % 3]; }
  int apex(int h) const { return tail(prev(h)); }

  void push(int h) {
    if (twin_[h] >= 0) h = std::min(h, twin_[h]);
    queued_.resize(twin_.size(), false);
    if (queued_[h]) return;
    queued_[h] = true;
    queue_.push_back(h);
  }

  void push_face(int f) {
    for (int k = 0; k < 3; ++k) push(3 * f + k);
  }

  // Cotangent of the angle opposite to h.
  double cotangent(int h) const {
    const Vec3 u = points_[tail(h)] - points_[apex(h)];
    const Vec3 v = points_[tail(next(h))] - points_[apex(h)];
    return u.dot(v) / u.cross(v).norm();
  }

  double cotangent_sum(int h) const { return cotangent(h) + cotangent(twin_[h]); }

  void improve(int h) {
    if (parent_[h / 3] == parent_[twin_[h] / 3]) {
      flip(h);
    } else if (splits_ < split_budget_) {
      split(h, crossing_parameter(h));
    }
  }

  // Where the other diagonal of the two unfolded triangles crosses h, as a fraction of h.
  double crossing_parameter(int h) const {
    const Vec3 edge = points_[tail(next(h))] - points_[tail(h)];
    const double length = edge.norm();
    const auto unfolded = [&](int apex_vertex) {
      const Vec3 u = points_[apex_vertex] - points_[tail(h)];
      return std::pair{u.dot(edge) / length, u.cross(edge).norm() / length};
    };
    const auto [x1, y1] = unfolded(apex(h));
    const auto [x2, y2] = unfolded(apex(twin_[h]));
    const double t = (x1 * y2 + x2 * y1) / ((y1 + y2) * length);
    return std::clamp(t, tolerance::delaunay_split_margin, 1.0 - tolerance::delaunay_split_margin);
  }

  void link(int g, int h) {
    twin_[g] = h;
    if (h >= 0) twin_[h] = g;
  }

  // Splits h = (a, b): its face (a, b, c) becomes (a, p, c) and the new (p, b, c).
  int split_one_side(int h, int p) {
    const int f = h / 3;
    const int b = tail(next(h));
    const int c = apex(h);
    const int outer = twin_[next(h)];
    const int g = static_cast<int>(triangles_.size());
    triangles_.push_back({p, b, c});
    parent_.push_back(parent_[f]);
    twin_.resize(twin_.size() + 3, -1);
    triangles_[f][(h + 1) % 3] = p;
    link(3 * g + 1, outer);
    link(3 * g + 2, next(h));
    return 3 * g;
  }

  void split(int h, double t) {
    const int opposite = twin_[h];
    const int p = static_cast<int>(points_.size());
    points_.push_back((1.0 - t) * points_[tail(h)] + t * points_[tail(next(h))]);
    loop_.push_back(-1);
    ++splits_;
    const int second = split_one_side(h, p);        // p -> b
    const int other = split_one_side(opposite, p);  // p -> a
    link(h, other);
    link(opposite, second);
    for (const int f : {h / 3, second / 3, opposite / 3, other / 3}) push_face(f);
  }

  // Replaces the diagonal (a, b) of the two faces (a, b, c), (b, a, d) by (d, c).
  void flip(int h) {
    const int g = twin_[h];
    const int f1 = h / 3;
    const int f2 = g / 3;
    const int a = tail(h);
    const int b = tail(g);
    const int c = apex(h);
    const int d = apex(g);
    const int bc = twin_[next(h)];
    const int ca = twin_[prev(h)];
    const int ad = twin_[next(g)];
    const int db = twin_[prev(g)];
    triangles_[f1] = {d, c, a};
    triangles_[f2] = {c, d, b};
    link(3 * f1, 3 * f2);
    link(3 * f1 + 1, ca);
    link(3 * f1 + 2, ad);
    link(3 * f2 + 1, db);
    link(3 * f2 + 2, bc);
    ++flips_;
    push_face(f1);
    push_face(f2);
  }

  void split_chords() {
    for (int h = 0; h < static_cast<int>(twin_.size()); ++h) {
      if (twin_[h] < 0) continue;
      const int loop = loop_[tail(h)];
      if (loop >= 0 && loop == loop_[tail(next(h))]) split(h, 0.5);
    }
  }

  int count_negative_edges() const {
    int count = 0;
    for (int h = 0; h < static_cast<int>(twin_.size()); ++h) {
      if (h < twin_[h] && cotangent_sum(h) < -tolerance::delaunay_cotangent) ++count;
    }
    return count;
  }

  DelaunaySurface result() {
    DelaunaySurface out;
    out.negative_edges = count_negative_edges();
    out.surface = {std::move(points_), std::move(triangles_)};
    out.parent_face = std::move(parent_);
    out.splits = static_cast<int>(splits_);
    out.flips = flips_;
    return out;
  }

  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> parent_, twin_, loop_, queue_;
  std::vector<bool> queued_;
  std::size_t splits_ = 0, split_budget_ = 0;
  int flips_ = 0;
};

}  // namespace

DelaunaySurface make_delaunay(const TriangleSurface& surface) {
  return Refiner(surface).run();
}

}  // namespace hexwall
