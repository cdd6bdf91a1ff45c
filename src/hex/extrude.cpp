#include "hex/extrude.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel.h"
#include "hex/column.h"
#include "hex/quality.h"
#include "quad/quality.h"

namespace hexwall {
namespace {

// Thickness shrinks by this factor per round where a hex is too bad: small enough steps to stay
// near the largest thickness possible, and 1e-3 of the asked one is reached in 40 rounds.
constexpr double shrink_factor = 0.84;
constexpr double least_thickness = 1e-3;
// A change of thickness along the surface by at most this slope keeps the outer surface smooth.
constexpr double greatest_slope = 0.3;
// A vertex counts as reduced below this share of the thickness asked for.
constexpr double reduced_below = 0.99;

class Thickness {
 public:
  Thickness(const QuadMesh& quads, const std::vector<Vec3>& directions,
            const ExtrudeOptions& options)
      : quads_(quads),
        directions_(directions),
        options_(options),
        fractions_(layer_fractions(options.layers, options.growth)),
        edges_(edges_of(quads)),
        values_(quads.points.size(), options.thickness) {}

  // Shrinks the thickness until every hex is as good as wanted.
  std::vector<double> run() {
    find_bounds();
    std::vector<char> bad(quads_.quads.size());
    for (;;) {
      parallel_for(bad.size(), [&](std::size_t q) {
        const ColumnQuality quality = column_quality(column(static_cast<int>(q)), fractions_);
        bad[q] = quality.scaled_jacobian < bound_[q] ? 1 : 0;
      });
      if (std::find(bad.begin(), bad.end(), 1) == bad.end()) return values_;
      shrink(bad);
      limit_slope();
    }
  }

 private:
  // What is wanted of a column: no more than half of what it has in the limit of no thickness.
  void find_bounds() {
    bound_.resize(quads_.quads.size());
    parallel_for(bound_.size(), [&](std::size_t q) {
      const double limit = flat_quality(column(static_cast<int>(q)));
      bound_[q] = std::min(options_.wanted_scaled_jacobian, 0.5 * limit);
    });
    const auto worst = std::min_element(bound_.begin(), bound_.end());
    if (*worst > 0.0) return;
    const Vec3& at = quads_.points[quads_.quads[worst - bound_.begin()][0]];
    throw MeshingError(fmt::format(
        "no wall can be extruded at ({:.6g}, {:.6g}, {:.6g}): the surface is folded there. Smooth "
        "or remesh it, or choose a smaller --size",
        at.x(), at.y(), at.z()));
  }

  Column column(int q) const {
    Column result = column_of(quads_, q, directions_, options_.thickness);
    for (int k = 0; k < 4; ++k) result.thickness[k] = values_[quads_.quads[q][k]];
    return result;
  }

  void shrink(const std::vector<char>& bad) {
    std::vector<char> marked(values_.size(), 0);
    for (std::size_t q = 0; q < bad.size(); ++q) {
      if (bad[q] == 0) continue;
      for (const int v : quads_.quads[q]) marked[v] = 1;
    }
    for (std::size_t v = 0; v < values_.size(); ++v) {
      if (marked[v] == 0) continue;
      values_[v] *= shrink_factor;
      if (values_[v] >= least_thickness * options_.thickness) continue;
      const Vec3& at = quads_.points[v];
      throw MeshingError(fmt::format(
          "no wall of positive thickness fits at ({:.6g}, {:.6g}, {:.6g}). Smooth or remesh the "
          "surface there, or choose a smaller --size",
          at.x(), at.y(), at.z()));
    }
  }

  void limit_slope() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b] : edges_) {
        const double room = greatest_slope * (quads_.points[a] - quads_.points[b]).norm();
        for (const auto& [low, high] : {std::pair{a, b}, std::pair{b, a}}) {
          if (values_[high] <= values_[low] + room * (1.0 + 1e-12)) continue;
          values_[high] = values_[low] + room;
          changed = true;
        }
      }
    }
  }

  const QuadMesh& quads_;
  const std::vector<Vec3>& directions_;
  const ExtrudeOptions& options_;
  std::vector<double> fractions_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<double> values_;
  std::vector<double> bound_;
};

class HexBuilder {
 public:
  HexBuilder(const QuadMesh& quads, const std::vector<std::string>& loop_names, int layers)
      : quads_(quads),
        loop_names_(loop_names),
        layers_(layers),
        vertex_count_(static_cast<int>(quads.points.size())),
        quad_count_(static_cast<int>(quads.quads.size())) {}

  // Layer by layer, in the order of the quads.
  HexMesh run(const std::vector<double>& fractions, const std::vector<double>& thickness,
              const std::vector<Vec3>& directions) {
    for (const double fraction : fractions) {
      for (int v = 0; v < vertex_count_; ++v) {
        mesh_.points.push_back(quads_.points[v] + fraction * thickness[v] * directions[v]);
      }
    }
    for (int layer = 0; layer < layers_; ++layer) add_layer(layer);
    add_skins();
    add_ends();
    return std::move(mesh_);
  }

 private:
  int at(int v, int level) const { return level * vertex_count_ + v; }

  void add_layer(int layer) {
    CellZone zone{fmt::format("layer_{}", layer + 1), {}};
    for (int q = 0; q < quad_count_; ++q) {
      std::array<int, 8> hex;
      for (int k = 0; k < 4; ++k) {
        hex[k] = at(quads_.quads[q][k], layer);
        hex[k + 4] = at(quads_.quads[q][k], layer + 1);
      }
      zone.hexes.push_back(static_cast<int>(mesh_.hexes.size()));
      mesh_.hexes.push_back(hex);
      mesh_.layer.push_back(layer);
      mesh_.quad.push_back(q);
    }
    mesh_.zones.push_back(std::move(zone));
  }

  void add_skins() {
    BoundaryPatch inner{"inner_wall", true, {}};
    BoundaryPatch outer{"outer_wall", true, {}};
    for (int q = 0; q < quad_count_; ++q) {
      const auto& [a, b, c, d] = quads_.quads[q];
      inner.faces.push_back({{a, d, c, b}, q});
      outer.faces.push_back({{at(a, layers_), at(b, layers_), at(c, layers_), at(d, layers_)},
                             (layers_ - 1) * quad_count_ + q});
    }
    mesh_.patches.push_back(std::move(inner));
    mesh_.patches.push_back(std::move(outer));
  }

  // The faces above the boundary edges of the quad mesh, one patch a loop.
  void add_ends() {
    std::vector<BoundaryPatch> ends;
    for (const std::string& name : loop_names_) ends.push_back({name, false, {}});
    for (const auto& [q, k] : boundary_edges()) {
      const int a = quads_.quads[q][k];
      const int b = quads_.quads[q][(k + 1) % 4];
      for (int i = 0; i < layers_; ++i) {
        ends[quads_.loop_of_vertex[a]].faces.push_back(
            {{at(a, i), at(b, i), at(b, i + 1), at(a, i + 1)}, i * quad_count_ + q});
      }
    }
    for (BoundaryPatch& end : ends) mesh_.patches.push_back(std::move(end));
  }

  // Quad and corner of the edges that belong to one quad only, in order of the quads.
  std::vector<std::array<int, 2>> boundary_edges() const {
    struct Side {
      std::array<int, 2> edge;
      std::array<int, 2> place;
    };
    std::vector<Side> sides;
    for (int q = 0; q < quad_count_; ++q) {
      for (int k = 0; k < 4; ++k) {
        const auto [low, high] = std::minmax(quads_.quads[q][k], quads_.quads[q][(k + 1) % 4]);
        if (quads_.loop_of_vertex[low] < 0 || quads_.loop_of_vertex[high] < 0) continue;
        sides.push_back({{low, high}, {q, k}});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.edge, a.place) < std::tie(b.edge, b.place);
    });
    std::vector<std::array<int, 2>> result;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const bool twice = (i > 0 && sides[i - 1].edge == sides[i].edge) ||
                         (i + 1 < sides.size() && sides[i + 1].edge == sides[i].edge);
      if (!twice) result.push_back(sides[i].place);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  const QuadMesh& quads_;
  const std::vector<std::string>& loop_names_;
  int layers_, vertex_count_, quad_count_;
  HexMesh mesh_;
};

double reduced_share(const QuadMesh& quads, const std::vector<double>& thickness, double asked) {
  double area = 0.0;
  double reduced = 0.0;
  for (int q = 0; q < static_cast<int>(quads.quads.size()); ++q) {
    const double quad_area = 0.5 * doubled_area_vector(corners_of(quads, q)).norm();
    area += quad_area;
    for (const int v : quads.quads[q]) {
      if (thickness[v] < reduced_below * asked) reduced += 0.25 * quad_area;
    }
  }
  return reduced / area;
}

}  // namespace

ExtrudeResult extrude(const QuadMesh& quads, const std::vector<Vec3>& directions,
                      const std::vector<std::string>& loop_names, const ExtrudeOptions& options) {
  ExtrudeResult result;
  result.thickness = Thickness(quads, directions, options).run();
  result.mesh =
      HexBuilder(quads, loop_names, options.layers)
          .run(layer_fractions(options.layers, options.growth), result.thickness, directions);
  result.scaled_jacobian = scaled_jacobians(result.mesh);
  result.min_scaled_jacobian =
      *std::min_element(result.scaled_jacobian.begin(), result.scaled_jacobian.end());
  const auto least = std::min_element(result.thickness.begin(), result.thickness.end());
  result.thickness_min = *least;
  result.worst_vertex = static_cast<int>(least - result.thickness.begin());
  result.reduced_area_fraction = reduced_share(quads, result.thickness, options.thickness);
  return result;
}

}  // namespace hexwall
