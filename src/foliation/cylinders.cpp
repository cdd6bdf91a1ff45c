#include "foliation/cylinders.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

// The circles of one side of the critical graph.
std::vector<Circle> find_circles(const CriticalGraph& graph, bool upper) {
  std::vector<Circle> circles;
  std::vector<bool> seen(graph.arcs.size(), false);
  for (std::size_t first = 0; first < graph.arcs.size(); ++first) {
    const auto on_side = [&](const Arc& arc) { return upper ? arc.has_upper : arc.has_lower; };
    if (seen[first] || !on_side(graph.arcs[first])) continue;
    Circle circle;
    for (int a = static_cast<int>(first); !seen[a];) {
      const Arc& arc = graph.arcs[a];
      seen[a] = true;
      circle.arcs.push_back(a);
      circle.start.push_back(circle.length);
      circle.length += arc.curve.length();
      if (!arc.is_plain_loop()) a = graph.sectors[upper ? arc.upper_end : arc.lower_end].out_arc;
    }
    circles.push_back(std::move(circle));
  }
  return circles;
}

// Which circle an arc lies on, and where that circle has it.
struct ArcPlace {
  int circle = -1;
  double start = 0.0;
};

std::vector<ArcPlace> places_on(const std::vector<Circle>& circles, std::size_t arc_count) {
  std::vector<ArcPlace> places(arc_count);
  for (std::size_t c = 0; c < circles.size(); ++c) {
    for (std::size_t i = 0; i < circles[c].arcs.size(); ++i) {
      places[circles[c].arcs[i]] = {static_cast<int>(c), circles[c].start[i]};
    }
  }
  return places;
}

class CylinderFinder {
 public:
  CylinderFinder(const Connectivity& mesh, const HolomorphicForm& form,
                 const std::vector<int>& ranks, const CriticalGraph& graph)
      : mesh_(mesh), form_(form), ranks_(ranks), graph_(graph) {}

  std::vector<Cylinder> run() {
    std::vector<Circle> bottoms = find_circles(graph_, true);
    std::vector<Circle> tops = find_circles(graph_, false);
    top_places_ = places_on(tops, graph_.arcs.size());
    std::vector<bool> taken(tops.size(), false);
    std::vector<Cylinder> cylinders;
    for (Circle& bottom : bottoms) {
      Cylinder cylinder;
      cylinder.bottom_circle = std::move(bottom);
      const int top = ascend(cylinder);
      if (taken[top]) throw Error(ExitCode::internal, "two cylinders share one circle");
      taken[top] = true;
      cylinder.top_circle = tops[top];
      finish(cylinder);
      cylinders.push_back(std::move(cylinder));
    }
    if (bottoms.size() != tops.size()) {
      throw Error(ExitCode::internal,
                  fmt::format("{} lower circles, but {} upper ones", bottoms.size(), tops.size()));
    }
    return cylinders;
  }

 private:
  // The edge on which the path leaves the bottom circle: in the middle of its longest arc, far from
  // the zeros, where x is most accurate.
  PathStep first_step(const Circle& circle) const {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < circle.arcs.size(); ++i) {
      if (graph_.arcs[circle.arcs[i]].curve.length() >
          graph_.arcs[circle.arcs[longest]].curve.length()) {
        longest = i;
      }
    }
    const Arc& arc = graph_.arcs[circle.arcs[longest]];
    const std::size_t middle = arc.curve.points.size() / 2;
    const double x = circle.start[longest] + arc.curve.x[middle];
    const EdgePoint& point = arc.curve.points[middle];
    if (arc.has_lower && arc.has_upper) {
      return {point.halfedge, x - point.t * form_.dx.along(mesh_, point.halfedge)};
    }
    return boundary_step(arc, circle.start[longest]);
  }

  // On a boundary loop the path leaves along the edge from the middle vertex to an apex above.
  PathStep boundary_step(const Arc& arc, double start) const {
    const std::size_t middle = (arc.curve.points.size() - 1) / 2;
    const int h = arc.curve.points[middle].halfedge;
    return {mesh_.rotate(h), start + arc.curve.x[middle]};
  }

  int steepest(int v) const {
    int best = -1;
    int h = mesh_.outgoing(v);
    do {
      if (best < 0 || ranks_[mesh_.tip(h)] > ranks_[mesh_.tip(best)]) best = h;
      h = mesh_.rotate(h);
    } while (h >= 0 && h != mesh_.outgoing(v));
    return best;
  }

  // The lowest critical curve that an upward edge meets above `rank`.
  const EdgeCrossing* next_crossing(int h, int rank) const {
    const auto [first, last] = graph_.crossings_of(mesh_.edge(h));
    for (std::size_t i = first; i < last; ++i) {
      if (graph_.crossings[i].rank > rank) return &graph_.crossings[i];
    }
    return nullptr;
  }

  // Follows rising edges up to the next critical component. Returns the circle met there.
  int ascend(Cylinder& cylinder) const {
    PathStep step = first_step(cylinder.bottom_circle);
    const int first_arc = cylinder.bottom_circle.arcs.front();
    int rank = graph_.components[graph_.arcs[first_arc].component].rank;
    for (;;) {
      cylinder.path.push_back(step);
      const double omega = form_.dx.along(mesh_, step.halfedge);
      if (const EdgeCrossing* crossing = next_crossing(step.halfedge, rank)) {
        const LevelCurve& curve = graph_.arcs[crossing->arc].curve;
        const double x = step.x_tail + curve.points[crossing->index].t * omega;
        return arrive(cylinder, crossing->arc, curve.x[crossing->index], x);
      }
      const int v = mesh_.tip(step.halfedge);
      if (mesh_.is_boundary_vertex(v) || graph_.junction_of_vertex[v] >= 0) {
        return arrive_at_vertex(cylinder, step.halfedge, step.x_tail + omega);
      }
      rank = ranks_[v];
      step = {steepest(v), step.x_tail + omega};
    }
  }

  int arrive_at_vertex(Cylinder& cylinder, int h, double x) const {
    const int v = mesh_.tip(h);
    if (graph_.junction_of_vertex[v] < 0) {
      const GraphPosition& at = graph_.loop_position[v];
      return arrive(cylinder, at.arc, graph_.arcs[at.arc].curve.x[at.index], x);
    }
    const Junction& junction = graph_.junctions[graph_.junction_of_vertex[v]];
    return arrive(cylinder, graph_.sectors[junction.sector_of(mesh_.twin(h))].out_arc, 0.0, x);
  }

  int arrive(Cylinder& cylinder, int arc, double offset, double x) const {
    const ArcPlace& place = top_places_[arc];
    cylinder.twist = place.start + offset - x;
    return place.circle;
  }

  void finish(Cylinder& cylinder) const {
    cylinder.bottom = graph_.arcs[cylinder.bottom_circle.arcs.front()].component;
    cylinder.top = graph_.arcs[cylinder.top_circle.arcs.front()].component;
    cylinder.y_bottom = graph_.components[cylinder.bottom].y;
    cylinder.y_top = graph_.components[cylinder.top].y;
  }

  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  const std::vector<int>& ranks_;
  const CriticalGraph& graph_;
  std::vector<ArcPlace> top_places_;
};

}  // namespace

std::vector<Cylinder> find_cylinders(const Connectivity& mesh, const HolomorphicForm& form,
                                     const std::vector<int>& ranks, const CriticalGraph& graph) {
  return CylinderFinder(mesh, form, ranks, graph).run();
}

LevelCurve level_curve(const Connectivity& mesh, const HolomorphicForm& form,
                       const Cylinder& cylinder, double y) {
  const auto step =
      std::find_if(cylinder.path.begin(), cylinder.path.end() - 1,
                   [&](const PathStep& s) { return form.y[mesh.tip(s.halfedge)] >= y; });
  const double low = form.y[mesh.tail(step->halfedge)];
  const double high = form.y[mesh.tip(step->halfedge)];
  const double x = step->x_tail + (y - low) / (high - low) * form.dx.along(mesh, step->halfedge);
  return trace_closed_level(mesh, form, step->halfedge, y, x);
}

}  // namespace hexwall
