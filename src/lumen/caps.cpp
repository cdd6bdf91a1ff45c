#include "lumen/caps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "core/errors.h"
#include "surface/loop_shape.h"

namespace hexwall {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Vec2 = Eigen::Vector2d;

// A triangle is too large when its circumscribed circle's radius is above this share of the wanted
// edge; that of an equilateral one is 0.58 of its edge.
constexpr double greatest_circumradius = 0.75;
// A new point keeps these shares of the wanted edge away from others, and from the rim.
constexpr double least_distance = 0.7;
constexpr double least_distance_from_rim = 0.45;
constexpr int edge_smoothing_rounds = 3;
constexpr int smoothing_rounds = 12;

Point to_point(const Vec2& p) {
  return {p.x(), p.y()};
}

// Marks the faces that are connected with infinity across edges that are no constraints.
void mark_outside(Cdt& cdt) {
  for (const auto& face : cdt.all_face_handles()) face->info() = false;
  std::vector<Cdt::Face_handle> front{cdt.infinite_face()};
  front.back()->info() = true;
  while (!front.empty()) {
    const Cdt::Face_handle face = front.back();
    front.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Cdt::Face_handle next = face->neighbor(k);
      if (face->is_constrained(k) || next->info()) continue;
      next->info() = true;
      front.push_back(next);
    }
  }
}

/// The triangulation of a disc in the plane.
class Disc {
 public:
  explicit Disc(std::vector<Vec2> rim) : rim_(std::move(rim)), points_(rim_) {
    for (const Vec2& p : rim_) polygon_.push_back(to_point(p));
    find_edges();
  }

  bool is_simple() const {
    return polygon_.is_simple() && polygon_.orientation() == CGAL::COUNTERCLOCKWISE;
  }

  void triangulate() {
    while (refine()) {
    }
    for (int round = 0; round < smoothing_rounds; ++round) smooth();
    connect();
  }

  /// Those of the rim, then those inside.
  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }

 private:
  // Lengths of the rim's edges, evened out along the rim.
  void find_edges() {
    const std::size_t n = rim_.size();
    for (std::size_t i = 0; i < n; ++i) {
      edge_.push_back((rim_[(i + 1) % n] - rim_[i]).norm());
      middle_.emplace_back(0.5 * (rim_[(i + 1) % n] + rim_[i]));
    }
    for (int round = 0; round < edge_smoothing_rounds; ++round) {
      const std::vector<double> before = edge_;
      for (std::size_t i = 0; i < n; ++i) {
        edge_[i] = 0.5 * before[i] + 0.25 * (before[(i + 1) % n] + before[(i + n - 1) % n]);
      }
    }
  }

  // Wanted edge length: that of the rim's edges, the nearest most.
  double wanted(const Vec2& p) const {
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < edge_.size(); ++i) {
      const double weight = 1.0 / ((p - middle_[i]).squaredNorm() + 1e-6 * edge_[i] * edge_[i]);
      sum += weight * edge_[i];
      weights += weight;
    }
    return sum / weights;
  }

  double distance_from_rim(const Vec2& p) const {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < rim_.size(); ++i) {
      const Vec2 along = rim_[(i + 1) % rim_.size()] - rim_[i];
      const double t = std::clamp((p - rim_[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - rim_[i] - t * along).norm());
    }
    return least;
  }

  bool is_inside(const Vec2& p) const {
    return polygon_.bounded_side(to_point(p)) == CGAL::ON_BOUNDED_SIDE;
  }

  void connect() {
    Cdt cdt;
    std::vector<Cdt::Vertex_handle> handles;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      handles.push_back(cdt.insert(to_point(points_[i])));
      handles.back()->info() = static_cast<int>(i);
    }
    for (std::size_t i = 0; i < rim_.size(); ++i) {
      cdt.insert_constraint(handles[i], handles[(i + 1) % rim_.size()]);
    }
    mark_outside(cdt);
    triangles_.clear();
    for (const auto& face : cdt.finite_face_handles()) {
      if (face->info()) continue;
      triangles_.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
    // In an order that does not depend on CGAL's.
    for (auto& t : triangles_)
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles_.begin(), triangles_.end());
  }

  struct Candidate {
    double radius;
    Vec2 center;
  };

  // Circumscribed circle of a triangle.
  Candidate circle(const std::array<int, 3>& t) const {
    const Vec2 u = points_[t[1]] - points_[t[0]];
    const Vec2 v = points_[t[2]] - points_[t[0]];
    const double twice = 2.0 * (u.x() * v.y() - u.y() * v.x());
    const Vec2 c(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                 u.x() * v.squaredNorm() - v.x() * u.squaredNorm());
    return {c.norm() / std::abs(twice), points_[t[0]] + c / twice};
  }

  bool has_room(const Vec2& p, double edge) const {
    return is_inside(p) && distance_from_rim(p) >= least_distance_from_rim * edge &&
           std::all_of(points_.begin(), points_.end(),
                       [&](const Vec2& q) { return (p - q).norm() >= least_distance * edge; });
  }

  // Points in the circles of triangles that are too large. \returns whether there were any.
  bool refine() {
    connect();
    std::vector<Candidate> candidates;
    for (const auto& t : triangles_) {
      const Candidate c = circle(t);
      if (c.radius > greatest_circumradius * wanted(c.center)) candidates.push_back(c);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.radius > b.radius; });
    const std::size_t before = points_.size();
    for (const Candidate& c : candidates) {
      if (has_room(c.center, wanted(c.center))) points_.push_back(c.center);
    }
    return points_.size() > before;
  }

  // Points inside go to the mean of their neighbours where that keeps clear of the rim.
  void smooth() {
    connect();
    std::vector<Vec2> sum(points_.size(), Vec2::Zero());
    std::vector<double> count(points_.size(), 0.0);
    for (const auto& t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        sum[t[k]] += points_[t[(k + 1) % 3]] + points_[t[(k + 2) % 3]];
        count[t[k]] += 2.0;
      }
    }
    for (std::size_t i = rim_.size(); i < points_.size(); ++i) {
      if (count[i] == 0.0) continue;
      const Vec2 mean = sum[i] / count[i];
      if (is_inside(mean) && distance_from_rim(mean) >= least_distance_from_rim * wanted(mean)) {
        points_[i] = mean;
      }
    }
  }

  std::vector<Vec2> rim_, points_;
  CGAL::Polygon_2<Kernel> polygon_;
  std::vector<double> edge_;
  std::vector<Vec2> middle_;
  std::vector<std::array<int, 3>> triangles_;
};

// Heights of all vertices over the plane: given on the rim, inside the mean of the neighbours'.
Eigen::VectorXd harmonic_heights(const Eigen::VectorXd& of_rim,
                                 const std::vector<std::array<int, 3>>& triangles,
                                 std::size_t count) {
  const auto rim = of_rim.size();
  const auto inside = static_cast<Eigen::Index>(count) - rim;
  Eigen::VectorXd heights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
  heights.head(rim) = of_rim;
  if (inside == 0 || of_rim.isZero(0.0)) return heights;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(inside);
  const auto join = [&](int a, int b) {
    if (a < rim) return;
    entries.emplace_back(a - rim, a - rim, 1.0);
    if (b < rim) {
      right[a - rim] += of_rim[b];
    } else {
      entries.emplace_back(a - rim, b - rim, -1.0);
    }
  };
  for (const auto& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      join(t[k], t[(k + 1) % 3]);
      join(t[(k + 1) % 3], t[k]);
    }
  }
  Eigen::SparseMatrix<double> matrix(inside, inside);
  matrix.setFromTriplets(entries.begin(), entries.end());
  heights.tail(inside) = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  return heights;
}

}  // namespace

Cap fill_loop(const std::vector<Vec3>& rim, const std::string& name) {
  const LoopShape shape = loop_shape(rim);
  const Vec3 e1 = shape.normal.unitOrthogonal();
  const Vec3 e2 = shape.normal.cross(e1);
  std::vector<Vec2> flat;
  Eigen::VectorXd heights(static_cast<Eigen::Index>(rim.size()));
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vec3 d = rim[i] - shape.center;
    flat.emplace_back(d.dot(e1), d.dot(e2));
    heights[static_cast<Eigen::Index>(i)] = d.dot(shape.normal);
  }
  Disc disc(std::move(flat));
  if (!disc.is_simple()) {
    throw MeshingError(
        fmt::format("the opening {} at {} is too far from flat to be filled. Cut it off at a plane "
                    "(--open-at), or add a flow extension (--extend)",
                    name, coordinates(shape.center)));
  }
  disc.triangulate();
  heights = harmonic_heights(heights, disc.triangles(), disc.points().size());
  Cap cap{{}, disc.triangles()};
  for (std::size_t i = rim.size(); i < disc.points().size(); ++i) {
    const Vec2& p = disc.points()[i];
    cap.points.push_back(shape.center + p.x() * e1 + p.y() * e2 +
                         heights[static_cast<Eigen::Index>(i)] * shape.normal);
  }
  return cap;
}

}  // namespace hexwall
