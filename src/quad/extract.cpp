#include "quad/extract.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/parallel.h"

namespace hexwall {
namespace {

class Extractor {
 public:
  Extractor(const TriangleSurface& surface, const Connectivity& mesh, const HolomorphicForm& form,
            const Foliation& foliation, const std::vector<RowSpacing>& spacing,
            const Quantisation& quantisation)
      : surface_(surface),
        mesh_(mesh),
        form_(form),
        graph_(foliation.graph),
        cylinders_(foliation.cylinders),
        strips_(foliation.strips),
        spacing_(spacing),
        numbers_(quantisation) {}

  ExtractResult run() {
    add_junctions();
    for (std::size_t a = 0; a < graph_.arcs.size(); ++a) add_arc(static_cast<int>(a));
    for (std::size_t c = 0; c < cylinders_.size(); ++c) add_cylinder(static_cast<int>(c));
    place_levels();
    return std::move(result_);
  }

 private:
  struct Level {
    int cylinder;
    double y;
    int first_vertex;
  };

  int add_vertex(const SurfacePoint& point, int loop) {
    result_.mesh.points.push_back(point.position);
    result_.mesh.loop_of_vertex.push_back(loop);
    result_.face.push_back(point.face);
    return static_cast<int>(result_.face.size()) - 1;
  }

  void add_junctions() {
    for (const Junction& junction : graph_.junctions) {
      const int v = junction.vertex;
      add_vertex({Connectivity::face(mesh_.outgoing(v)), surface_.points[v]},
                 mesh_.loop_of_vertex(v));
    }
  }

  // Vertices of an arc from its first to its last point, both included. A plain loop starts at its
  // first vertical line and ends there again.
  void add_arc(int a) {
    const Arc& arc = graph_.arcs[a];
    const auto& lines = strips_.arc_lines[a];
    std::vector<double> breaks;
    for (const LineOnArc& line : lines) breaks.push_back(line.offset);
    if (arc.is_plain_loop()) {
      breaks.push_back(breaks.front() + arc.curve.length());
    } else {
      breaks.insert(breaks.begin(), 0.0);
      breaks.push_back(arc.curve.length());
    }
    const int loop = arc.has_upper && arc.has_lower ? -1 : graph_.components[arc.component].loop;
    std::vector<int> vertices;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const int count = numbers_.across[strips_.arc_strips[a][i]];
      for (int k = 0; k < count; ++k) {
        if (i == 0 && k == 0 && arc.from >= 0) {
          vertices.push_back(arc.from);
          continue;
        }
        double x = breaks[i] + (breaks[i + 1] - breaks[i]) * k / count;
        if (x > arc.curve.length()) x -= arc.curve.length();
        vertices.push_back(add_vertex(point_at(surface_, mesh_, arc.curve, x), loop));
      }
    }
    vertices.push_back(arc.to >= 0 ? arc.to : vertices.front());
    arc_vertices_.push_back(std::move(vertices));
  }

  std::vector<int> ring(const Circle& circle) const {
    std::vector<int> vertices;
    for (const int a : circle.arcs) {
      vertices.insert(vertices.end(), arc_vertices_[a].begin(), arc_vertices_[a].end() - 1);
    }
    return vertices;
  }

  // The ring of the top circle, turned to start at the cylinder's first vertical line.
  std::vector<int> top_ring(int c) const {
    const Circle& circle = cylinders_[c].top_circle;
    const LineInCylinder& first = strips_.in_cylinder[c].front();
    int shift = 0;
    for (const int a : circle.arcs) {
      if (a == first.top_arc) break;
      shift += static_cast<int>(arc_vertices_[a].size()) - 1;
    }
    for (int i = 0; i < first.top_interval; ++i) {
      shift += numbers_.across[strips_.arc_strips[first.top_arc][i]];
    }
    std::vector<int> vertices = ring(circle);
    std::rotate(vertices.begin(), vertices.begin() + shift, vertices.end());
    return vertices;
  }

  void add_cylinder(int c) {
    const int rows = numbers_.along[c];
    std::vector<std::vector<int>> rings{ring(cylinders_[c].bottom_circle)};
    for (int j = 1; j < rows; ++j) {
      levels_.push_back({c, level_y(c, j), static_cast<int>(result_.face.size())});
      std::vector<int> level;
      for (std::size_t i = 0; i < rings[0].size(); ++i) level.push_back(add_vertex({}, -1));
      rings.push_back(std::move(level));
    }
    rings.push_back(top_ring(c));
    for (int j = 0; j < rows; ++j) {
      add_quads(c, rings[j], rings[j + 1]);
      result_.row_height.resize(result_.mesh.quads.size(), level_y(c, j + 1) - level_y(c, j));
      result_.column_width.resize(result_.mesh.quads.size(),
                                  cylinders_[c].circumference() / numbers_.around(strips_, c));
    }
    add_vertical_lines(c, rings);
    first_patch_ += static_cast<int>(strips_.in_cylinder[c].size());
  }

  // Height of the ring above row j - 1.
  double level_y(int c, int j) const {
    return spacing_[c].y_of(spacing_[c].wanted() * j / numbers_.along[c]);
  }

  // +x to the right and +y up, seen from outside.
  void add_quads(int c, const std::vector<int>& low, const std::vector<int>& high) {
    std::size_t i = 0;
    int patch = first_patch_;
    for (const LineInCylinder& line : strips_.in_cylinder[c]) {
      for (int k = 0; k < numbers_.across[line.strip]; ++k, ++i) {
        const std::size_t next = (i + 1) % low.size();
        result_.mesh.quads.push_back({low[i], low[next], high[next], high[i]});
        result_.mesh.cylinder.push_back(c);
        result_.mesh.patch.push_back(patch);
      }
      ++patch;
    }
  }

  void add_vertical_lines(int c, const std::vector<std::vector<int>>& rings) {
    std::size_t i = 0;
    for (const LineInCylinder& line : strips_.in_cylinder[c]) {
      if (strips_.lines[line.line].sector >= 0) {
        std::vector<int> vertices;
        vertices.reserve(rings.size());
        for (const auto& level : rings) vertices.push_back(level[i]);
        result_.vertical_lines.push_back(std::move(vertices));
      }
      i += static_cast<std::size_t>(numbers_.across[line.strip]);
    }
  }

  void place_levels() {
    std::atomic<int> corrected{0};
    parallel_tasks(levels_.size(), [&](std::size_t i) {
      if (place_level(levels_[i])) ++corrected;
    });
    result_.corrected_levels = corrected;
  }

  bool place_level(const Level& level) {
    const Cylinder& cylinder = cylinders_[level.cylinder];
    const LevelCurve curve = level_curve(mesh_, form_, cylinder, level.y);
    const double fraction = (level.y - cylinder.y_bottom) / cylinder.height();
    const auto& lines = strips_.in_cylinder[level.cylinder];
    const auto x_of = [&](const LineInCylinder& line) {
      return (1.0 - fraction) * line.x_bottom + fraction * line.x_top;
    };
    int vertex = level.first_vertex;
    for (std::size_t q = 0; q < lines.size(); ++q) {
      const double start = x_of(lines[q]);
      const double end =
          q + 1 < lines.size() ? x_of(lines[q + 1]) : x_of(lines[0]) + cylinder.circumference();
      const int count = numbers_.across[lines[q].strip];
      for (int k = 0; k < count; ++k, ++vertex) {
        double x = start + (end - start) * k / count;
        x -= std::floor((x - curve.start()) / curve.length()) * curve.length();
        const SurfacePoint point = point_at(surface_, mesh_, curve, x);
        result_.mesh.points[vertex] = point.position;
        result_.face[vertex] = point.face;
      }
    }
    return curve.corrected;
  }

  const TriangleSurface& surface_;
  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  const CriticalGraph& graph_;
  const std::vector<Cylinder>& cylinders_;
  const Strips& strips_;
  const std::vector<RowSpacing>& spacing_;
  const Quantisation& numbers_;
  std::vector<std::vector<int>> arc_vertices_;
  std::vector<Level> levels_;
  int first_patch_ = 0;
  ExtractResult result_;
};

}  // namespace

ExtractResult extract_quads(const TriangleSurface& surface, const Connectivity& mesh,
                            const HolomorphicForm& form, const Foliation& foliation,
                            const std::vector<RowSpacing>& spacing,
                            const Quantisation& quantisation) {
  return Extractor(surface, mesh, form, foliation, spacing, quantisation).run();
}

}  // namespace hexwall
