#include "dec/delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "core/cancel.h"
#include "core/tolerances.h"
#include "surface/editable_mesh.h"

namespace hexwall {
namespace {

class Refiner {
 public:
  Refiner(const TriangleSurface& input, const Connectivity& mesh) : mesh_(input, mesh) {
    for (int v = 0; v < mesh.vertex_count(); ++v) loop_.push_back(mesh.loop_of_vertex(v));
    // Segmented surfaces need less than four splits a vertex; the floor is for coarse surfaces of
    // long triangles, which take hundreds. Past this the input is hopeless and the caller is told.
    split_budget_ = std::max<std::size_t>(8 * input.points.size(), 100000);
  }

  DelaunaySurface run() {
    split_chords();
    for (int h = 0; h < mesh_.halfedge_count(); ++h) push(h);
    while (!queue_.empty()) {
      throw_if_cancelled();
      const int h = queue_.back();
      queue_.pop_back();
      queued_[h] = false;
      if (mesh_.twin(h) >= 0 && cotangent_sum(h) < -tolerance::delaunay_cotangent) improve(h);
    }
    return result();
  }

 private:
  void push(int h) {
    if (mesh_.twin(h) >= 0) h = std::min(h, mesh_.twin(h));
    queued_.resize(mesh_.halfedge_count(), false);
    if (queued_[h]) return;
    queued_[h] = true;
    queue_.push_back(h);
  }

  void push_face(int f) {
    for (int k = 0; k < 3; ++k) push(3 * f + k);
  }

  // Cotangent of the angle opposite to h.
  double cotangent(int h) const {
    const Vec3 u = mesh_.point(mesh_.tail(h)) - mesh_.point(mesh_.apex(h));
    const Vec3 v = mesh_.point(mesh_.tip(h)) - mesh_.point(mesh_.apex(h));
    return u.dot(v) / u.cross(v).norm();
  }

  double cotangent_sum(int h) const { return cotangent(h) + cotangent(mesh_.twin(h)); }

  void improve(int h) {
    const int f = h / 3;
    const int g = mesh_.twin(h) / 3;
    if (mesh_.parent()[f] == mesh_.parent()[g]) {
      mesh_.flip(h);
      ++flips_;
      push_face(f);
      push_face(g);
    } else if (splits_ < split_budget_) {
      split(h, split_parameter(h));
    }
  }

  // Where to split h, as a fraction of it. Both halves are Delaunay where the other diagonal of the
  // two unfolded triangles crosses it, and around there. The angles at the new vertex are larger
  // than those that they replace at the ends: of the edges opposite to them, as many as possible
  // stay Delaunay.
  double split_parameter(int h) const {
    const Vec3 start = mesh_.point(mesh_.tail(h));
    const Vec3 edge = mesh_.point(mesh_.tip(h)) - start;
    const double length = edge.norm();
    // With h on the x axis, from 0 to `length`, and the apexes of its triangles at (x, y): sums
    // over both of the cotangents at the tail and at the tip, and of those of the halves' opposite
    // angles when the other half has no length.
    double at_tail = 0.0;
    double at_tip = 0.0;
    double of_first = 0.0;
    double of_second = 0.0;
    std::array<double, 2> x;
    std::array<double, 2> y;
    Wishes wishes;
    for (int side = 0; side < 2; ++side) {
      const int g = side == 0 ? h : mesh_.twin(h);
      const Vec3 u = mesh_.point(mesh_.apex(g)) - start;
      x[side] = u.dot(edge) / length;
      y[side] = u.cross(edge).norm() / length;
      const double rest = length - x[side];
      at_tail += x[side] / y[side];
      at_tip += rest / y[side];
      of_first += (x[side] * x[side] + y[side] * y[side]) / y[side];
      of_second += (rest * rest + y[side] * y[side]) / y[side];
      const int before = EditableMesh::prev(g);
      const int after = EditableMesh::next(g);
      wishes.from[side] = x[side] - y[side] * cotangent_beyond(side == 0 ? before : after);
      wishes.to[side] = x[side] + y[side] * cotangent_beyond(side == 0 ? after : before);
    }
    const double crossing = (x[0] * y[1] + x[1] * y[0]) / (y[0] + y[1]);
    double least = tolerance::delaunay_split_margin * length;
    double most = length - least;
    if (at_tip > 0.0) least = std::max(least, length - of_second / at_tip);
    if (at_tail > 0.0) most = std::min(most, of_first / at_tail);
    // The margin comes first.
    if (least > most) least = most = std::clamp(crossing, most, least);
    return wishes.best_place(crossing, least, most) / length;
  }

  /// From where and up to where the edges opposite to a new vertex want it.
  struct Wishes {
    std::array<double, 2> from, to;

    std::ptrdiff_t met_at(double p) const {
      return std::count_if(from.begin(), from.end(), [p](double f) { return p >= f; }) +
             std::count_if(to.begin(), to.end(), [p](double t) { return p <= t; });
    }

    // In the range given, and as near to `p` as possible.
    double best_place(double p, double least, double most) const {
      double best = std::clamp(p, least, most);
      for (const double wish : {from[0], from[1], to[0], to[1]}) {
        const double place = std::clamp(wish, least, most);
        const auto gain = met_at(place) - met_at(best);
        if (gain > 0 || (gain == 0 && std::abs(place - p) < std::abs(best - p))) best = place;
      }
      return best;
    }
  };

  // Of the triangle beyond an edge. Infinite if the edge need not stay Delaunay: at the boundary,
  // and inside a triangle of the input, where it can be flipped.
  double cotangent_beyond(int h) const {
    const int twin = mesh_.twin(h);
    const bool is_free = twin < 0 || mesh_.parent()[twin / 3] == mesh_.parent()[h / 3];
    return is_free ? std::numeric_limits<double>::infinity() : cotangent(twin);
  }

  void split(int h, double t) {
    mesh_.split(h, t);
    loop_.push_back(-1);
    ++splits_;
    for (const int f : mesh_.faces_at_last_split()) push_face(f);
  }

  void split_chords() {
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (mesh_.twin(h) < 0) continue;
      const int loop = loop_[mesh_.tail(h)];
      if (loop >= 0 && loop == loop_[mesh_.tip(h)]) split(h, 0.5);
    }
  }

  int count_negative_edges() const {
    int count = 0;
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (h < mesh_.twin(h) && cotangent_sum(h) < -tolerance::delaunay_cotangent) ++count;
    }
    return count;
  }

  DelaunaySurface result() {
    DelaunaySurface out;
    out.negative_edges = count_negative_edges();
    out.surface = mesh_.take_surface();
    out.parent_face = mesh_.take_parent();
    out.splits = static_cast<int>(splits_);
    out.flips = flips_;
    return out;
  }

  EditableMesh mesh_;
  std::vector<int> loop_, queue_;
  std::vector<bool> queued_;
  std::size_t splits_ = 0, split_budget_ = 0;
  int flips_ = 0;
};

}  // namespace

DelaunaySurface make_delaunay(const TriangleSurface& surface, const Connectivity& mesh) {
  return Refiner(surface, mesh).run();
}

}  // namespace hexwall
