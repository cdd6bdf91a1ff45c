#include "lumen/core_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "quad/boundary.h"
#include "quad/quality.h"
#include "surface/self_intersection.h"

namespace hexwall {
namespace {

// Height of a pyramid relative to the size of its quad: between flat neighbours a regular
// tetrahedron would fit at 0.71, but on the inside of a tube there is less room.
constexpr double height_factor = 0.5;
// Long quads get no pyramids higher than this times the quad's width.
constexpr double height_per_width = 0.8;
// Pyramids that are so much higher must not meet: tetrahedra need room between them.
constexpr double clearance = 1.3;
constexpr double lowering = 0.8;
// Between neighbouring pyramids there should be this angle, or their tetrahedra would be slivers;
// they are not lowered beyond the given share for it.
constexpr double least_gap = 45.0 * std::numbers::pi / 180.0;
constexpr double lowest_for_gap = 0.2;
// Lower ones would be slivers.
constexpr double least_height = 0.02;

struct QuadFrame {
  Vec3 center;
  Vec3 inward;    // unit
  double size;    // square root of the area
  double height;  // of a pyramid with all the room it needs
};

QuadFrame frame_of(const QuadMesh& quads, int q) {
  const auto p = corners_of(quads, q);
  const Vec3 doubled = doubled_area_vector(p);
  QuadFrame frame;
  frame.center = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  frame.inward = -doubled.normalized();
  frame.size = std::sqrt(0.5 * doubled.norm());
  const double width =
      0.5 * std::min((p[0] + p[1] - p[2] - p[3]).norm(), (p[1] + p[2] - p[3] - p[0]).norm());
  frame.height = std::min(height_factor * frame.size, height_per_width * width);
  return frame;
}

class Builder {
 public:
  Builder(const QuadMesh& quads, const std::vector<std::string>& names)
      : quads_(quads), names_(names) {
    result_.surface.points = quads.points;
    for (int q = 0; q < static_cast<int>(quads.quads.size()); ++q) {
      frames_.push_back(frame_of(quads, q));
    }
    result_.edge = sizes_of_vertices();
  }

  CoreSurface split() {
    for (const auto& [a, b, c, d] : quads_.quads) {
      const auto& p = quads_.points;
      if ((p[a] - p[c]).norm() <= (p[b] - p[d]).norm()) {
        add({a, b, c}, -1);
        add({a, c, d}, -1);
      } else {
        add({a, b, d}, -1);
        add({b, c, d}, -1);
      }
    }
    result_.first_apex = static_cast<int>(result_.surface.points.size());
    add_caps();
    return std::move(result_);
  }

  CoreSurface with_pyramids() {
    result_.has_apexes = true;
    result_.first_apex = static_cast<int>(result_.surface.points.size());
    for (std::size_t q = 0; q < frames_.size(); ++q) {
      const int apex = static_cast<int>(result_.surface.points.size());
      result_.surface.points.emplace_back(Vec3::Zero());
      result_.edge.push_back(frames_[q].size);
      for (int k = 0; k < 4; ++k) {
        add({quads_.quads[q][k], quads_.quads[q][(k + 1) % 4], apex}, -1);
      }
    }
    add_caps();
    lower_apexes();
    return std::move(result_);
  }

 private:
  void add(const std::array<int, 3>& triangle, int opening) {
    result_.surface.triangles.push_back(triangle);
    result_.opening.push_back(opening);
  }

  std::vector<double> sizes_of_vertices() const {
    std::vector<double> sum(quads_.points.size(), 0.0);
    std::vector<double> count(quads_.points.size(), 0.0);
    for (std::size_t q = 0; q < frames_.size(); ++q) {
      for (const int v : quads_.quads[q]) {
        sum[v] += frames_[q].size;
        count[v] += 1.0;
      }
    }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= count[v];
    return sum;
  }

  void add_caps() {
    result_.first_cap_point = static_cast<int>(result_.surface.points.size());
    const auto rims = cap_rims(quads_);
    for (std::size_t loop = 0; loop < rims.size(); ++loop) {
      std::vector<Vec3> rim;
      double edges = 0.0;
      for (const int v : rims[loop]) {
        rim.push_back(quads_.points[v]);
        edges += result_.edge[v] / static_cast<double>(rims[loop].size());
      }
      const Cap cap = fill_loop(rim, names_[loop]);
      const auto first = static_cast<int>(result_.surface.points.size());
      const auto on_rim = static_cast<int>(rim.size());
      result_.surface.points.insert(result_.surface.points.end(), cap.points.begin(),
                                    cap.points.end());
      result_.edge.resize(result_.surface.points.size(), edges);
      for (std::array<int, 3> t : cap.triangles) {
        for (int& v : t) v = v < on_rim ? rims[loop][v] : first + v - on_rim;
        add(t, static_cast<int>(loop));
      }
    }
  }

  void place_apexes(const std::vector<double>& height, double factor) {
    for (std::size_t q = 0; q < frames_.size(); ++q) {
      result_.surface.points[result_.first_apex + q] =
          frames_[q].center + factor * height[q] * frames_[q].inward;
    }
  }

  /// Two quads that share an edge.
  struct Neighbours {
    std::array<int, 2> edge;  // in the direction of the first quad
    std::array<int, 2> quads;
  };

  std::vector<Neighbours> neighbours() const {
    std::map<std::array<int, 2>, int> quad_of_side;
    std::vector<Neighbours> result;
    for (int q = 0; q < static_cast<int>(quads_.quads.size()); ++q) {
      for (int k = 0; k < 4; ++k) {
        const int a = quads_.quads[q][k];
        const int b = quads_.quads[q][(k + 1) % 4];
        const auto other = quad_of_side.find({b, a});
        if (other != quad_of_side.end()) result.push_back({{a, b}, {q, other->second}});
        quad_of_side[{a, b}] = q;
      }
    }
    return result;
  }

  // The angle between the pyramids on both sides of an edge, in the core.
  double gap(const Neighbours& n) const {
    const auto& points = result_.surface.points;
    const Vec3 along = (points[n.edge[1]] - points[n.edge[0]]).normalized();
    const auto across = [&](int quad) -> Vec3 {
      const Vec3 d = points[result_.first_apex + quad] - points[n.edge[0]];
      return d - d.dot(along) * along;
    };
    const Vec3 u = across(n.quads[0]);
    const Vec3 w = across(n.quads[1]);
    // The first quad lies on the left of the edge, seen from outside; the core turns from its
    // pyramid to the other about the edge's direction.
    const double angle = std::atan2(along.dot(w.cross(u)), u.dot(w));
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
  }

  void widen_gaps(std::vector<double>& height) {
    const std::vector<Neighbours> all = neighbours();
    for (bool changed = true; changed;) {
      changed = false;
      place_apexes(height, 1.0);
      for (const Neighbours& n : all) {
        const double angle = gap(n);
        if (angle >= least_gap && angle <= 1.5 * std::numbers::pi) continue;
        for (const int q : n.quads) {
          const double lowest = lowest_for_gap * frames_[q].height;
          if (height[q] <= lowest) continue;
          height[q] = std::max(lowest, 0.9 * height[q]);
          changed = true;
        }
      }
    }
  }

  // Quads whose pyramids meet others or a cap at `height` with the clearance.
  std::vector<int> colliding(const std::vector<double>& height) {
    place_apexes(height, clearance);
    std::vector<int> found;
    for (const auto& [f, g] : self_intersections(result_.surface)) {
      for (const int t : {f, g}) {
        if (result_.opening[t] < 0) found.push_back(t / 4);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void lower_apexes() {
    std::vector<double> height;
    for (const QuadFrame& frame : frames_) height.push_back(frame.height);
    widen_gaps(height);
    for (std::vector<int> quads = colliding(height); !quads.empty(); quads = colliding(height)) {
      for (const int q : quads) {
        height[q] *= lowering;
        if (height[q] >= least_height * frames_[q].height) continue;
        throw MeshingError(fmt::format(
            "there is no room for pyramids inside the layers at {}. Choose thinner layers "
            "(--thickness) or a smaller --size, or smooth the surface there",
            coordinates(frames_[q].center)));
      }
    }
    place_apexes(height, 1.0);
    for (std::size_t q = 0; q < frames_.size(); ++q) {
      if (height[q] < frames_[q].height) ++result_.lowered;
    }
  }

  const QuadMesh& quads_;
  const std::vector<std::string>& names_;
  std::vector<QuadFrame> frames_;
  CoreSurface result_;
};

}  // namespace

std::vector<std::vector<int>> cap_rims(const QuadMesh& quads) {
  const int loops = 1 + *std::max_element(quads.loop_of_vertex.begin(), quads.loop_of_vertex.end());
  // The quads lie on the left of their sides, the cap on the other side.
  std::vector<int> next(quads.points.size(), -1);
  std::vector<int> first(static_cast<std::size_t>(loops), -1);
  for (const QuadSide& side : boundary_sides(quads)) {
    const auto [a, b] = ends_of(quads, side);
    next[b] = a;
    int& start = first[quads.loop_of_vertex[a]];
    if (start < 0) start = a;
  }
  std::vector<std::vector<int>> rims(static_cast<std::size_t>(loops));
  for (int loop = 0; loop < loops; ++loop) {
    int v = first[loop];
    do {
      rims[loop].push_back(v);
      v = next[v];
    } while (v != first[loop]);
  }
  return rims;
}

CoreSurface split_surface(const QuadMesh& quads, const std::vector<std::string>& names) {
  return Builder(quads, names).split();
}

CoreSurface pyramid_surface(const QuadMesh& quads, const std::vector<std::string>& names) {
  return Builder(quads, names).with_pyramids();
}

}  // namespace hexwall
