#include "quad/pole_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include <Eigen/SparseCholesky>

#include "quad/quality.h"

namespace hexwall {
namespace {

using Ring = std::vector<int>;

// Rings moved with the cap, relative to the quads along its side: the cap's corners are felt that
// far.
constexpr double moved_rings = 0.75;

/// The quads beside the edges of a mesh.
class EdgeQuads {
 public:
  explicit EdgeQuads(const QuadMesh& mesh) : mesh_(mesh), valence_(mesh.points.size(), 0) {
    sides_.reserve(4 * mesh.quads.size());
    for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
      for (int k = 0; k < 4; ++k) {
        sides_.push_back({mesh.quads[q][k], mesh.quads[q][(k + 1) % 4], q});
        ++valence_[mesh.quads[q][k]];
      }
    }
    std::sort(sides_.begin(), sides_.end());
  }

  /// The quad with the side from `a` to `b`; -1 for none.
  int quad(int a, int b) const {
    const Side wanted{a, b, -1};
    const auto found = std::lower_bound(sides_.begin(), sides_.end(), wanted);
    return found != sides_.end() && (*found)[0] == a && (*found)[1] == b ? (*found)[2] : -1;
  }

  /// The vertex after `v` in a quad.
  int after(int quad, int v) const {
    const auto& corners = mesh_.quads[quad];
    return corners[(std::find(corners.begin(), corners.end(), v) - corners.begin() + 1) % 4];
  }

  /// Interior vertex with four quads around it.
  bool is_regular(int v) const { return mesh_.loop_of_vertex[v] < 0 && valence_[v] == 4; }

  /// Vertices of a boundary loop, with the mesh on the left.
  Ring loop(int number) const {
    std::map<int, int> next;
    for (const auto& [a, b, q] : sides_) {
      if (mesh_.loop_of_vertex[a] == number && quad(b, a) < 0) next[a] = b;
    }
    Ring ring{next.begin()->first};
    while (next.at(ring.back()) != ring.front()) ring.push_back(next.at(ring.back()));
    return ring;
  }

 private:
  using Side = std::array<int, 3>;
  const QuadMesh& mesh_;
  std::vector<Side> sides_;
  std::vector<int> valence_;
};

/// The opposite sides of the quads to the left of a ring, if they form a ring of regular vertices.
std::optional<Ring> next_ring(const EdgeQuads& quads, const Ring& ring) {
  Ring result;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const int before = quads.quad(ring[(i + n - 1) % n], ring[i]);
    const int here = quads.quad(ring[i], ring[(i + 1) % n]);
    if (before < 0 || here < 0) return std::nullopt;
    // The side of both quads that leads away from the ring.
    const int v = quads.after(before, ring[i]);
    const bool is_common = quads.after(here, v) == ring[i];
    if (!is_common || !quads.is_regular(v)) return std::nullopt;
    result.push_back(v);
  }
  return result;
}

class CapBuilder {
 public:
  CapBuilder(QuadMesh& mesh, std::vector<SurfacePoint>& places, const PoleSite& site,
             const std::vector<double>& ring_spacing, const SurfaceProjector& projector)
      : mesh_(mesh),
        places_(places),
        loop_(site.loop),
        center_(site.center),
        disk_faces_(site.disk_faces),
        surface_(projector.surface()),
        projector_(projector) {
    const EdgeQuads quads(mesh);
    rings_.push_back(quads.loop(loop_));
    n_ = static_cast<int>(rings_[0].size());
    side_ = n_ / 4;
    radius_.push_back(1.0);
    const int most = std::max(1, static_cast<int>(std::lround(moved_rings * side_)));
    while (static_cast<int>(rings_.size()) <= most) {
      auto next = next_ring(quads, rings_.back());
      if (!next) break;
      const int q = quads.quad(rings_.back()[0], rings_.back()[1]);
      radius_.push_back(radius_.back() * std::exp(2.0 * std::numbers::pi / n_ * ring_spacing[q]));
      rings_.push_back(std::move(*next));
    }
  }

  PoleCap run() {
    turn(best_turn());
    remember_places();
    PoleCap cap{loop_, n_, static_cast<int>(mesh_.quads.size()), 0.0};
    add_grid();
    place();
    for (const int v : rings_[0]) mesh_.loop_of_vertex[v] = -1;
    double area = 0.0;
    for (int q = cap.first_quad; q < static_cast<int>(mesh_.quads.size()); ++q) {
      area += 0.5 * doubled_area_vector(corners_of(mesh_, q)).norm();
    }
    cap.mean_edge = std::sqrt(area / (side_ * side_));
    return cap;
  }

 private:
  // The first corner at which the four sides are most alike in length.
  int best_turn() const {
    int best = 0;
    double least = std::numeric_limits<double>::max();
    for (int t = 0; t < side_; ++t) {
      double sum = 0.0;
      double squares = 0.0;
      for (int k = 0; k < 4; ++k) {
        const Vec3& a = mesh_.points[rings_[0][(t + k * side_) % n_]];
        const Vec3& b = mesh_.points[rings_[0][(t + (k + 1) * side_) % n_]];
        sum += (b - a).norm();
        squares += (b - a).squaredNorm();
      }
      const double spread = squares / 4.0 - sum * sum / 16.0;
      if (spread >= least) continue;
      least = spread;
      best = t;
    }
    return best;
  }

  void turn(int first) {
    for (Ring& ring : rings_) std::rotate(ring.begin(), ring.begin() + first, ring.end());
  }

  void remember_places() {
    for (const Ring& ring : rings_) {
      ring_places_.emplace_back();
      for (const int v : ring) ring_places_.back().push_back(places_[v]);
    }
  }

  // Grid vertex (i, j), 0 … side: on its rim those of the loop, from (0, 0) along j first.
  int& grid(int i, int j) { return grid_[i * (side_ + 1) + j]; }

  void add_grid() {
    grid_.assign((side_ + 1) * (side_ + 1), -1);
    for (int k = 0; k < side_; ++k) {
      grid(0, k) = rings_[0][k];
      grid(k, side_) = rings_[0][side_ + k];
      grid(side_, side_ - k) = rings_[0][2 * side_ + k];
      grid(side_ - k, 0) = rings_[0][3 * side_ + k];
    }
    for (int i = 1; i < side_; ++i) {
      for (int j = 1; j < side_; ++j) {
        grid(i, j) = static_cast<int>(mesh_.points.size());
        mesh_.points.push_back(center_.position);
        mesh_.loop_of_vertex.push_back(-1);
        places_.push_back(center_);
      }
    }
    const int patch = 1 + *std::max_element(mesh_.patch.begin(), mesh_.patch.end());
    for (int i = 0; i < side_; ++i) {
      for (int j = 0; j < side_; ++j) {
        mesh_.quads.push_back({grid(i, j), grid(i + 1, j), grid(i + 1, j + 1), grid(i, j + 1)});
        mesh_.cylinder.push_back(-1);
        mesh_.patch.push_back(patch);
      }
    }
  }

  // Unknowns of the layout: all vertices of the grid and of the rings but the outermost one.
  void number_unknowns() {
    const std::size_t last = rings_.size() - 1;
    const auto add = [&](int v) {
      if (unknown_.try_emplace(v, static_cast<int>(vertices_.size())).second)
        vertices_.push_back(v);
    };
    for (const int v : grid_) {
      if (last > 0 || mesh_.loop_of_vertex[v] < 0) add(v);
    }
    for (std::size_t j = 1; j < last; ++j) {
      for (const int v : rings_[j]) add(v);
    }
    for (int i = 0; i < n_; ++i) fixed_[rings_[last][i]] = std::polar(radius_[last], angle(i));
  }

  // With the mesh on its left the loop runs clockwise around the hole, seen from outside.
  double angle(int i) const { return -2.0 * std::numbers::pi * i / n_; }

  std::vector<std::array<int, 2>> layout_edges() {
    std::vector<std::array<int, 2>> edges;
    for (int i = 0; i <= side_; ++i) {
      for (int j = 0; j < side_; ++j) {
        // Rim edges belong to the rings.
        if (i > 0 && i < side_) edges.push_back({grid(i, j), grid(i, j + 1)});
        if (i > 0 && i < side_) edges.push_back({grid(j, i), grid(j + 1, i)});
      }
    }
    for (std::size_t j = 0; j < rings_.size(); ++j) {
      for (int i = 0; i < n_; ++i) {
        edges.push_back({rings_[j][i], rings_[j][(i + 1) % n_]});
        if (j > 0) edges.push_back({rings_[j - 1][i], rings_[j][i]});
      }
    }
    return edges;
  }

  // Positions in the plane: every vertex at the mean of its neighbours.
  std::vector<std::complex<double>> layout() {
    number_unknowns();
    const int size = static_cast<int>(vertices_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(size, 2);
    for (const auto& edge : layout_edges()) {
      for (const auto& [v, w] : {std::pair{edge[0], edge[1]}, std::pair{edge[1], edge[0]}}) {
        const auto row = unknown_.find(v);
        if (row == unknown_.end()) continue;
        entries.emplace_back(row->second, row->second, 1.0);
        if (const auto column = unknown_.find(w); column != unknown_.end()) {
          entries.emplace_back(row->second, column->second, -1.0);
        } else {
          rhs.row(row->second) += Eigen::RowVector2d(fixed_.at(w).real(), fixed_.at(w).imag());
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::MatrixXd solution = solver.solve(rhs);
    std::vector<std::complex<double>> positions;
    for (int i = 0; i < size; ++i) positions.emplace_back(solution(i, 0), solution(i, 1));
    return positions;
  }

  void place() {
    const auto positions = layout();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const int v = vertices_[i];
      places_[v] = surface_point(positions[i]);
      mesh_.points[v] = places_[v].position;
    }
  }

  SurfacePoint surface_point(std::complex<double> z) const {
    const double turns = -std::arg(z) / (2.0 * std::numbers::pi);
    const double column = (turns - std::floor(turns)) * n_;
    const int i = static_cast<int>(column) % n_;
    const double t = column - std::floor(column);
    const double radius = std::abs(z);
    if (radius < 1.0) {
      const Vec3 rim =
          (1.0 - t) * ring_places_[0][i].position + t * ring_places_[0][(i + 1) % n_].position;
      return on_disk((1.0 - radius) * center_.position + radius * rim);
    }
    std::size_t j = 0;
    while (j + 2 < radius_.size() && radius_[j + 1] < radius) ++j;
    if (j + 1 == radius_.size()) return ring_places_[0][i];
    const double s = std::clamp((radius - radius_[j]) / (radius_[j + 1] - radius_[j]), 0.0, 1.0);
    const auto on_ring = [&](std::size_t ring) -> Vec3 {
      return (1.0 - t) * ring_places_[ring][i].position +
             t * ring_places_[ring][(i + 1) % n_].position;
    };
    return projector_.project((1.0 - s) * on_ring(j) + s * on_ring(j + 1), ring_places_[j][i].face);
  }

  // Nearest point of the disk's triangles.
  SurfacePoint on_disk(const Vec3& p) const {
    SurfacePoint best = center_;
    for (const int f : disk_faces_) {
      const auto& [a, b, c] = surface_.triangles[f];
      const Vec3 q =
          nearest_point_of_triangle(p, surface_.points[a], surface_.points[b], surface_.points[c]);
      if ((q - p).squaredNorm() < (best.position - p).squaredNorm()) best = {f, q};
    }
    return best;
  }

  QuadMesh& mesh_;
  std::vector<SurfacePoint>& places_;
  int loop_;
  const SurfacePoint& center_;
  const std::vector<int>& disk_faces_;
  const TriangleSurface& surface_;
  const SurfaceProjector& projector_;
  int n_ = 0;
  int side_ = 0;
  std::vector<Ring> rings_;     // the loop, then regular rings around it
  std::vector<double> radius_;  // of the rings in the plane
  std::vector<std::vector<SurfacePoint>> ring_places_;
  std::vector<int> grid_;
  std::vector<int> vertices_;   // that are laid out
  std::map<int, int> unknown_;  // vertex -> index in vertices_
  std::map<int, std::complex<double>> fixed_;
};

}  // namespace

PoleCap close_pole(QuadMesh& mesh, std::vector<SurfacePoint>& places, const PoleSite& site,
                   const std::vector<double>& ring_spacing, const SurfaceProjector& projector) {
  return CapBuilder(mesh, places, site, ring_spacing, projector).run();
}

}  // namespace hexwall
