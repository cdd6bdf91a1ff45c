#include "dec/delaunay.h"

#include <algorithm>
#include <cmath>
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
      split(h, crossing_parameter(h));
    }
  }

  // Where the other diagonal of the two unfolded triangles crosses h, as a fraction of h.
  double crossing_parameter(int h) const {
    const Vec3 start = mesh_.point(mesh_.tail(h));
    const Vec3 edge = mesh_.point(mesh_.tip(h)) - start;
    const double length = edge.norm();
    const auto unfolded = [&](int apex_vertex) {
      const Vec3 u = mesh_.point(apex_vertex) - start;
      return std::pair{u.dot(edge) / length, u.cross(edge).norm() / length};
    };
    const auto [x1, y1] = unfolded(mesh_.apex(h));
    const auto [x2, y2] = unfolded(mesh_.apex(mesh_.twin(h)));
    const double t = (x1 * y2 + x2 * y1) / ((y1 + y2) * length);
    return std::clamp(t, tolerance::delaunay_split_margin, 1.0 - tolerance::delaunay_split_margin);
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
