#include "hex/skin.h"

#include <algorithm>
#include <numeric>

#include "core/cancel.h"
#include "core/parallel.h"
#include "quad/boundary.h"
#include "quad/quality.h"
#include "surface/self_intersection.h"
#include "surface/separation.h"

namespace hexwall {
namespace {

// Scaled Jacobian from which on no split of a face folds it.
constexpr double surely_convex = 1e-3;

}  // namespace

Skin::Skin(const QuadMesh& quads, Side side) : level_(side == Side::outward ? 1.0 : -1.0) {
  const auto base = static_cast<int>(quads.points.size());
  for (int q = 0; q < static_cast<int>(quads.quads.size()); ++q) {
    const auto& [a, b, c, d] = quads.quads[q];
    faces_.push_back({{a, b, c, d}, q});
    faces_.push_back({{base + a, base + d, base + c, base + b}, q});
  }
  for (const QuadSide& side_of_ring : boundary_sides(quads)) {
    const auto [a, b] = ends_of(quads, side_of_ring);
    faces_.push_back({{b, a, base + a, base + b}, side_of_ring.quad});
  }
}

std::vector<Vec3> Skin::points(const std::vector<ColumnEdge>& columns, double clearance) const {
  std::vector<Vec3> points;
  points.reserve(2 * columns.size());
  for (const ColumnEdge& edge : columns) points.push_back(edge.at(clearance * level_));
  for (const ColumnEdge& edge : columns) points.push_back(edge.base);
  return points;
}

std::vector<int> Skin::in_doubt(const std::vector<Vec3>& points, const std::vector<int>& faces,
                                const std::vector<char>& is_active) const {
  const Separation separation(points);
  std::vector<Eigen::AlignedBox3d> boxes(faces.size());
  std::vector<char> doubtful(faces.size());
  parallel_for(faces.size(), [&](std::size_t i) {
    const std::array<Vec3, 4> corners = corners_of(points, faces_[faces[i]].vertices);
    for (const Vec3& corner : corners) boxes[i].extend(corner);
    const bool acts = is_active.empty() || is_active[i] != 0;
    doubtful[i] = acts && scaled_jacobian(corners) < surely_convex ? 1 : 0;
  });
  const auto may_meet = [&](int a, int b) {
    return !separation.is_certain(faces_[faces[a]].vertices, faces_[faces[b]].vertices);
  };
  for (const auto& [f, g] : box_pairs(boxes, may_meet, is_active)) doubtful[f] = doubtful[g] = 1;
  std::vector<int> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (doubtful[i] != 0) result.push_back(faces[i]);
  }
  return result;
}

std::vector<char> Skin::active_faces(const std::vector<Vec3>& points) const {
  if (last_points_.empty()) return {};
  std::vector<char> is_active(faces_.size());
  parallel_for(faces_.size(), [&](std::size_t i) {
    const auto& vertices = faces_[i].vertices;
    const bool has_moved = std::any_of(vertices.begin(), vertices.end(),
                                       [&](int v) { return points[v] != last_points_[v]; });
    is_active[i] = has_moved ? 1 : 0;
  });
  for (const int face : last_doubtful_) is_active[face] = 1;
  return is_active;
}

std::vector<int> Skin::collisions_of(const std::vector<Vec3>& points,
                                     const std::vector<int>& doubtful) const {
  if (doubtful.empty()) return {};
  TriangleSurface surface{points, {}};
  for (const int diagonal : {0, 1}) {
    throw_if_cancelled();
    surface.triangles.clear();
    for (const int face : doubtful) {
      const auto at = [&](int k) { return faces_[face].vertices[(k + diagonal) % 4]; };
      surface.triangles.push_back({at(0), at(1), at(2)});
      surface.triangles.push_back({at(0), at(2), at(3)});
    }
    std::vector<int> quads;
    for (const auto& [f, g] : self_intersections(surface)) {
      quads.insert(quads.end(), {faces_[doubtful[f / 2]].quad, faces_[doubtful[g / 2]].quad});
    }
    std::sort(quads.begin(), quads.end());
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    if (!quads.empty()) return quads;
  }
  return {};
}

std::vector<int> Skin::collisions(const std::vector<ColumnEdge>& columns, double clearance) {
  std::vector<int> all(faces_.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Vec3> at = points(columns, clearance);
  std::vector<int> doubtful = in_doubt(at, all, active_faces(at));
  std::vector<int> quads = collisions_of(at, doubtful);
  last_points_ = std::move(at);
  // Where faces meet, not all that were in doubt were looked at to the end.
  if (quads.empty()) doubtful.clear();
  last_doubtful_ = std::move(doubtful);
  return quads;
}

std::vector<int> Skin::collisions(const std::vector<ColumnEdge>& columns, double clearance,
                                  const std::vector<int>& among) const {
  std::vector<int> faces;
  for (int i = 0; i < static_cast<int>(faces_.size()); ++i) {
    if (std::binary_search(among.begin(), among.end(), faces_[i].quad)) faces.push_back(i);
  }
  const std::vector<Vec3> at = points(columns, clearance);
  return collisions_of(at, in_doubt(at, faces, {}));
}

}  // namespace hexwall
