#include "quad/relax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "core/parallel.h"
#include "quad/quality.h"
#include "quad/vertex_corners.h"
#include "surface/projector.h"

namespace hexwall {
namespace {

using Corners = std::array<Vec3, 4>;

// No edge gets shorter than this share of the size wanted, unless it is already: corners may be
// right on edges of no length, but cells on them are slivers.
constexpr double least_edge = 0.05;

// The rectangle nearest to a quad in turn and position, its sides half way, as ratios go, from
// their lengths to the target size.
Corners fitted_rectangle(const Corners& p, const QuadSize& size) {
  const Vec3 center = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  const Vec3 along_x = 0.5 * (p[1] - p[0] + p[2] - p[3]);
  const Vec3 along_y = 0.5 * (p[3] - p[0] + p[2] - p[1]);
  const Vec3 normal = along_x.cross(along_y).normalized();
  const auto pulled = [](double length, double target) {
    return length > 0.0 ? std::sqrt(target * length) : target;
  };
  const double width = pulled(along_x.norm(), size.along_x);
  const double height = pulled(along_y.norm(), size.along_y);
  const Vec3 u = (width * along_x + height * along_y.cross(normal)).normalized();
  const Vec3 half_u = 0.5 * width * u;
  const Vec3 half_v = 0.5 * height * normal.cross(u);
  return {center - half_u - half_v, center + half_u - half_v, center + half_u + half_v,
          center - half_u + half_v};
}

class Relaxer {
 public:
  Relaxer(QuadMesh& mesh, std::vector<int>& face, const std::vector<QuadSize>& size,
          const TriangleSurface& surface, const Connectivity& connectivity, int iterations)
      : mesh_(mesh),
        face_(face),
        size_(size),
        iterations_(iterations),
        projector_(surface, connectivity),
        corners_(mesh),
        targets_(mesh.quads.size()),
        segment_(mesh.points.size(), 0),
        jacobian_(mesh.quads.size()) {
    for (const auto& loop : connectivity.loops()) {
      std::vector<Vec3> points;
      for (const int v : loop) points.push_back(surface.points[v]);
      loops_.emplace_back(std::move(points));
    }
    find_segments();
    for (int f = 0; f < connectivity.face_count(); ++f) {
      normal_.push_back(doubled_area_vector(surface, f).normalized());
    }
  }

  RelaxResult run() {
    parallel_for(jacobian_.size(), [&](std::size_t q) {
      jacobian_[q] = scaled_jacobian(corners_of(mesh_, static_cast<int>(q)));
    });
    for (int i = 0; i < iterations_; ++i) {
      step();
      ++result_.iterations;
    }
    return result_;
  }

 private:
  // The segment of its loop on which each loop vertex lies: the nearest of all.
  void find_segments() {
    parallel_for(mesh_.points.size(), [&](std::size_t v) {
      if (mesh_.loop_of_vertex[v] < 0) return;
      const LoopCurve& loop = loops_[mesh_.loop_of_vertex[v]];
      double least = std::numeric_limits<double>::max();
      for (int s = 0; s < loop.segment_count(); ++s) {
        int reached = s;
        const double distance = (loop.project(mesh_.points[v], reached) - mesh_.points[v]).norm();
        if (distance < least) {
          least = distance;
          segment_[v] = reached;
        }
      }
    });
  }

  void step() {
    parallel_for(mesh_.quads.size(), [&](std::size_t q) {
      targets_[q] = fitted_rectangle(corners_of(mesh_, static_cast<int>(q)), size_[q]);
    });
    moved_ = mesh_.points;
    moved_face_ = face_;
    moved_segment_ = segment_;
    parallel_for(moved_.size(), [&](std::size_t v) { move_vertex(static_cast<int>(v)); });
    undo_harmful_moves();
    std::swap(mesh_.points, moved_);
    std::swap(face_, moved_face_);
    std::swap(segment_, moved_segment_);
  }

  void move_vertex(int v) {
    Vec3 sum = Vec3::Zero();
    const auto corners = corners_.at(v);
    for (const auto& [q, k] : corners) sum += targets_[q][k];
    const Vec3 p = sum / static_cast<double>(corners.size());
    if (mesh_.loop_of_vertex[v] >= 0) {
      moved_[v] = loops_[mesh_.loop_of_vertex[v]].project(p, moved_segment_[v]);
    } else {
      const SurfacePoint point = projector_.project(p, face_[v]);
      moved_[v] = point.position;
      moved_face_[v] = point.face;
    }
  }

  // Whether an edge of a quad is much too short, and has become shorter.
  bool is_pinched(int q, const Corners& before, const Corners& after) const {
    const double least = least_edge * std::min(size_[q].along_x, size_[q].along_y);
    for (int k = 0; k < 4; ++k) {
      const int j = (k + 1) % 4;
      const double length = (after[k] - after[j]).squaredNorm();
      if (length < least * least && length < (before[k] - before[j]).squaredNorm()) return true;
    }
    return false;
  }

  // Whether a quad is turned over: its normal points to the other side than the surface's.
  bool is_turned(const std::array<int, 4>& quad, const Corners& corners,
                 const std::vector<int>& face) const {
    Vec3 outward = Vec3::Zero();
    for (const int v : quad) outward += normal_[face[v]];
    return doubled_area_vector(corners).dot(outward) < 0.0;
  }

  // Takes back the moves of all corners of quads that would become worse than the worst one was (or
  // than they were, if that was inverted), turned over, or pinched.
  void undo_harmful_moves() {
    const double worst = *std::min_element(jacobian_.begin(), jacobian_.end());
    const std::vector<double> jacobian_before = jacobian_;
    std::vector<char> harmful(jacobian_.size());
    std::vector<int> suspects(jacobian_.size());
    std::iota(suspects.begin(), suspects.end(), 0);
    while (!suspects.empty()) {
      parallel_for(suspects.size(), [&](std::size_t i) {
        const int q = suspects[i];
        const Corners before = corners_of(mesh_, q);
        const Corners after = corners_of(moved_, mesh_.quads[q]);
        jacobian_[q] = scaled_jacobian(after);
        const bool is_worse = jacobian_[q] < std::min(jacobian_before[q], std::max(worst, 0.0));
        const bool turns_over = is_turned(mesh_.quads[q], after, moved_face_) &&
                                !is_turned(mesh_.quads[q], before, face_);
        harmful[q] = is_worse || turns_over || is_pinched(q, before, after) ? 1 : 0;
      });
      std::vector<int> undone;
      for (const int q : suspects) {
        if (harmful[q] == 0) continue;
        for (const int v : mesh_.quads[q]) {
          if (undo(v)) undone.push_back(v);
        }
      }
      suspects = quads_around(undone);
    }
  }

  std::vector<int> quads_around(const std::vector<int>& vertices) const {
    std::vector<int> quads;
    for (const int v : vertices) {
      for (const QuadCorner& corner : corners_.at(v)) quads.push_back(corner.quad);
    }
    std::sort(quads.begin(), quads.end());
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    return quads;
  }

  bool undo(int v) {
    if (moved_[v] == mesh_.points[v]) return false;
    moved_[v] = mesh_.points[v];
    moved_face_[v] = face_[v];
    moved_segment_[v] = segment_[v];
    ++result_.frozen_moves;
    return true;
  }

  QuadMesh& mesh_;
  std::vector<int>& face_;
  const std::vector<QuadSize>& size_;
  int iterations_;
  SurfaceProjector projector_;
  std::vector<LoopCurve> loops_;
  VertexCorners corners_;
  std::vector<Corners> targets_;
  std::vector<int> segment_, moved_face_, moved_segment_;
  std::vector<double> jacobian_;  // scaled Jacobians of the quads
  std::vector<Vec3> normal_;      // of the surface's triangles
  std::vector<Vec3> moved_;
  RelaxResult result_;
};

}  // namespace

RelaxResult relax(QuadMesh& mesh, std::vector<int>& face, const std::vector<QuadSize>& size,
                  const TriangleSurface& surface, const Connectivity& connectivity,
                  int iterations) {
  return Relaxer(mesh, face, size, surface, connectivity, iterations).run();
}

}  // namespace hexwall
