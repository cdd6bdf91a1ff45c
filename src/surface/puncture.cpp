#include "surface/puncture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/editable_mesh.h"

namespace hexwall {
namespace {

// Edges up to 1.3 radii from the centre are split until they are this short, relative to the
// radius: the loop then has some 2 pi / 0.15 = 40 vertices, with chords within 0.3 % of the radius.
constexpr double longest_edge = 0.25;
constexpr double refined_within = 1.3;
// A disk takes some hundreds of splits. Far more come from triangles that no splits can mend.
constexpr int most_splits = 20000;
// Loop vertices keep this fraction of an edge away from its ends: no needles, and the loop is out
// of round by less than 0.1 * longest_edge.
constexpr double split_margin = 0.1;
// A centre with a barycentric coordinate below this lies on the edge.
constexpr double on_edge = 1e-6;

class Puncher {
 public:
  Puncher(const TriangleSurface& surface, const Connectivity& mesh)
      : mesh_(surface, mesh), original_count_(static_cast<int>(surface.points.size())) {}

  // False if the disk is none.
  bool cut(const SurfaceDisk& disk) {
    const int start = center_vertex(disk);
    if (start < 0 || !refine(disk)) return false;
    measure(disk);
    if (!mark_inside(start)) return false;
    split_along_circle();
    return remove_inside();
  }

  PuncturedSurface result() {
    PuncturedSurface out;
    out.disk_faces = std::move(disk_faces_);
    removed_.resize(mesh_.surface().triangles.size(), 0);
    std::vector<int> number(mesh_.surface().points.size(), -1);
    for (std::size_t f = 0; f < removed_.size(); ++f) {
      if (removed_[f] != 0) continue;
      for (const int v : mesh_.surface().triangles[f]) number[v] = 0;
    }
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<int>(out.surface.points.size());
      out.surface.points.push_back(mesh_.surface().points[v]);
      out.original_vertex.push_back(static_cast<int>(v) < original_count_ ? static_cast<int>(v)
                                                                          : -1);
    }
    for (std::size_t f = 0; f < removed_.size(); ++f) {
      if (removed_[f] != 0) continue;
      const auto& [a, b, c] = mesh_.surface().triangles[f];
      out.surface.triangles.push_back({number[a], number[b], number[c]});
      out.parent_face.push_back(mesh_.parent()[f]);
    }
    for (const int v : hole_vertex_) out.hole_vertex.push_back(number[v]);
    return out;
  }

 private:
  bool is_removed(int f) const { return f < static_cast<int>(removed_.size()) && removed_[f] != 0; }

  // False if the boundary comes too near: its edges must stay, which leaves long ones beside them.
  bool refine(const SurfaceDisk& disk) {
    const auto is_too_long = [&](int h) {
      if (mesh_.length(h) <= longest_edge * disk.radius) return false;
      const Vec3 u = disk.center.position - mesh_.point(mesh_.tail(h));
      const Vec3 edge = mesh_.point(mesh_.tip(h)) - mesh_.point(mesh_.tail(h));
      const double t = std::clamp(u.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
      return (u - t * edge).norm() < refined_within * disk.radius;
    };
    std::vector<int> queue;
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_removed(h / 3) && is_too_long(h)) queue.push_back(h);
    }
    int splits = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      if (!is_too_long(queue[i])) continue;
      if (mesh_.twin(queue[i]) < 0 || ++splits > most_splits) return false;
      mesh_.split(longest_from(queue[i]), 0.5);
      queue.push_back(queue[i]);
      for (const int f : mesh_.faces_at_last_split()) {
        for (int k = 0; k < 3; ++k) {
          if (is_too_long(3 * f + k)) queue.push_back(3 * f + k);
        }
      }
    }
    return true;
  }

  // Follows ever longer edges from triangle to triangle, up to one that is longest on both sides:
  // halving that one never leaves an angle less than half of what was there.
  int longest_from(int h) const {
    for (;;) {
      int longest = h;
      for (const int side : {h, mesh_.twin(h)}) {
        for (const int g : {EditableMesh::next(side), EditableMesh::prev(side)}) {
          if (mesh_.twin(g) >= 0 && mesh_.length(g) > mesh_.length(longest)) longest = g;
        }
      }
      if (longest == h) return h;
      h = longest;
    }
  }

  void measure(const SurfaceDisk& disk) {
    distance_.clear();
    for (const Vec3& p : mesh_.surface().points) {
      const double distance = (p - disk.center.position).norm() - disk.radius;
      distance_.push_back(distance == 0.0 ? std::numeric_limits<double>::min() : distance);
    }
  }

  // A vertex at the centre, made if there is none; -1 if the centre has been cut out.
  int center_vertex(const SurfaceDisk& disk) {
    for (int f = 0; f < static_cast<int>(mesh_.parent().size()); ++f) {
      if (mesh_.parent()[f] != disk.center.face || is_removed(f)) continue;
      const Vec3 w = barycentric_coordinates(mesh_.surface(), {f, disk.center.position});
      int least = 0;
      int greatest = 0;
      if (w.minCoeff(&least) < -on_edge) continue;
      if (w.maxCoeff(&greatest) > 1.0 - on_edge) return mesh_.surface().triangles[f][greatest];
      if (w[least] > on_edge) return mesh_.insert(f, disk.center.position);
      const int h = 3 * f + (least + 1) % 3;  // the side opposite to the corner of no weight
      return mesh_.twin(h) >= 0 ? mesh_.split(h, w[(least + 2) % 3]) : -1;
    }
    return -1;
  }

  // Marks the vertices that edges inside the circle join to `start`. False if one of them lies on
  // the boundary or on another hole.
  bool mark_inside(int start) {
    std::vector<int> outgoing(mesh_.surface().points.size(), -1);
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (!is_removed(h / 3)) outgoing[mesh_.tail(h)] = h;
    }
    inside_.assign(outgoing.size(), 0);
    inside_[start] = 1;
    std::vector<int> queue{start};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      int h = outgoing[queue[i]];
      const int first = h;
      do {
        const int v = mesh_.tip(h);
        if (distance_[v] < 0.0 && inside_[v] == 0) {
          inside_[v] = 1;
          queue.push_back(v);
        }
        h = mesh_.twin(EditableMesh::prev(h));
        if (h < 0) return false;
      } while (h != first);
    }
    return true;
  }

  bool is_inside(int v) const { return inside_[v] != 0; }
  bool is_on_rim(int v) const { return distance_[v] == 0.0; }

  // Half-edges that a split makes or moves to another face come later in the numbering.
  void split_along_circle() {
    for (int h = 0; h < mesh_.halfedge_count(); ++h) {
      if (is_removed(h / 3) || !is_inside(mesh_.tail(h)) || distance_[mesh_.tip(h)] <= 0.0)
        continue;
      const double inside = distance_[mesh_.tail(h)];
      const double outside = distance_[mesh_.tip(h)];
      mesh_.split(h, std::clamp(inside / (inside - outside), split_margin, 1.0 - split_margin));
      distance_.push_back(0.0);
      inside_.push_back(0);
    }
  }

  // Removes the triangles with a vertex inside, if they form a disk.
  bool remove_inside() {
    const auto& triangles = mesh_.surface().triangles;
    removed_.resize(triangles.size(), 0);
    std::vector<int> faces;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const auto& t = triangles[f];
      if (removed_[f] != 0 ||
          std::none_of(t.begin(), t.end(), [&](int v) { return is_inside(v); })) {
        continue;
      }
      removed_[f] = 1;
      faces.push_back(static_cast<int>(f));
    }
    int rim_edges = 0;
    for (const int f : faces) {
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (is_inside(mesh_.tail(h)) || is_inside(mesh_.tip(h))) continue;
        mesh_.detach(h);
        ++rim_edges;
      }
    }
    return is_disk(faces, rim_edges);
  }

  bool is_disk(const std::vector<int>& faces, int rim_edges) {
    std::vector<int> vertices;
    std::vector<int> parents;
    for (const int f : faces) {
      const auto& t = mesh_.surface().triangles[f];
      vertices.insert(vertices.end(), t.begin(), t.end());
      parents.push_back(mesh_.parent()[f]);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::sort(parents.begin(), parents.end());
    parents.erase(std::unique(parents.begin(), parents.end()), parents.end());
    // A disk is connected, its rim has as many vertices as edges, and its Euler number is 1.
    const auto on_rim = [&](int v) { return is_on_rim(v); };
    const auto rim = std::count_if(vertices.begin(), vertices.end(), on_rim);
    const auto face_count = static_cast<long>(faces.size());
    const long edge_count = (3 * face_count + rim_edges) / 2;
    const long euler = static_cast<long>(vertices.size()) - edge_count + face_count;
    if (rim != rim_edges || euler != 1) return false;
    hole_vertex_.push_back(*std::find_if(vertices.begin(), vertices.end(), on_rim));
    disk_faces_.push_back(std::move(parents));
    return true;
  }

  EditableMesh mesh_;
  int original_count_;
  std::vector<double> distance_;  // #V from the circle, negative inside
  std::vector<char> inside_;      // #V of the disk that is being cut
  std::vector<char> removed_;     // #F of what has been cut out
  std::vector<int> hole_vertex_;
  std::vector<std::vector<int>> disk_faces_;
};

}  // namespace

std::optional<PuncturedSurface> puncture(const TriangleSurface& surface, const Connectivity& mesh,
                                         const std::vector<SurfaceDisk>& disks) {
  Puncher puncher(surface, mesh);
  for (const SurfaceDisk& disk : disks) {
    if (!puncher.cut(disk)) return std::nullopt;
  }
  return puncher.result();
}

}  // namespace hexwall
