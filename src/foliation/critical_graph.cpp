#include "foliation/critical_graph.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"

namespace hexwall {
namespace {

// Length given to an arc whose x does not advance, relative to the longest arc: only arcs between
// half-zeros can be that short, and any positive value keeps the combinatorics valid.
constexpr double shortest_arc = 1e-6;

class GraphBuilder {
 public:
  GraphBuilder(const Connectivity& mesh, const HolomorphicForm& form, const std::vector<int>& ranks)
      : mesh_(mesh), form_(form), ranks_(ranks) {}

  CriticalGraph run() {
    graph_.zeros = find_zeros(mesh_, ranks_);
    graph_.junction_of_vertex.assign(mesh_.vertex_count(), -1);
    graph_.loop_position.assign(mesh_.vertex_count(), {});
    add_components();
    for (const Zero& zero : graph_.zeros) add_junction(zero);
    for (std::size_t j = 0; j < graph_.junctions.size(); ++j) trace_arcs(static_cast<int>(j));
    for (std::size_t i = 0; i < mesh_.loops().size(); ++i) add_loop_arcs(static_cast<int>(i));
    link_sectors();
    make_arcs_monotone();
    collect_crossings();
    return std::move(graph_);
  }

 private:
  void add_components() {
    for (const auto& loop : mesh_.loops()) {
      const int v = loop.front();
      graph_.components.push_back({mesh_.loop_of_vertex(v), ranks_[v], form_.y[v], {}});
    }
    for (const Zero& zero : graph_.zeros) {
      if (zero.loop >= 0) continue;
      graph_.components.push_back({-1, ranks_[zero.vertex], form_.y[zero.vertex], {}});
    }
  }

  int component_of_rank(int rank) const {
    const auto found = std::find_if(graph_.components.begin(), graph_.components.end(),
                                    [&](const CriticalComponent& c) { return c.rank == rank; });
    return static_cast<int>(found - graph_.components.begin());
  }

  bool is_up(int spoke) const { return ranks_[mesh_.tip(spoke)] > ranks_[mesh_.tail(spoke)]; }

  // Outgoing half-edges of v to vertices of other rank, counter-clockwise. At an interior vertex
  // the first one starts a sector.
  std::vector<int> spokes_of(int v) const {
    std::vector<int> spokes;
    int h = mesh_.outgoing(v);
    do {
      if (ranks_[mesh_.tip(h)] != ranks_[v]) spokes.push_back(h);
      h = mesh_.rotate(h);
    } while (h >= 0 && h != mesh_.outgoing(v));
    if (!mesh_.is_boundary_vertex(v)) {
      std::size_t first = 0;
      while (is_up(spokes[first]) == is_up(spokes[(first + spokes.size() - 1) % spokes.size()])) {
        ++first;
      }
      std::rotate(spokes.begin(), spokes.begin() + static_cast<std::ptrdiff_t>(first),
                  spokes.end());
    }
    return spokes;
  }

  void add_junction(const Zero& zero) {
    Junction junction;
    junction.vertex = zero.vertex;
    junction.component = component_of_rank(ranks_[zero.vertex]);
    junction.spokes = spokes_of(zero.vertex);
    const int index = static_cast<int>(graph_.junctions.size());
    for (std::size_t i = 0; i < junction.spokes.size(); ++i) {
      const bool up = is_up(junction.spokes[i]);
      if (i == 0 || up != is_up(junction.spokes[i - 1])) {
        graph_.sectors.push_back({index, up, -1, -1});
      }
      junction.spoke_sector.push_back(static_cast<int>(graph_.sectors.size()) - 1);
    }
    graph_.junction_of_vertex[zero.vertex] = index;
    graph_.junctions.push_back(std::move(junction));
  }

  int add_arc(LevelCurve curve, int component) {
    Arc arc;
    arc.curve = std::move(curve);
    arc.component = component;
    graph_.arcs.push_back(std::move(arc));
    graph_.components[component].arcs.push_back(static_cast<int>(graph_.arcs.size()) - 1);
    return static_cast<int>(graph_.arcs.size()) - 1;
  }

  // Arcs start where the neighbours, counter-clockwise, change from below to above.
  void trace_arcs(int j) {
    const std::vector<int> spokes = graph_.junctions[j].spokes;
    const bool closed = !mesh_.is_boundary_vertex(graph_.junctions[j].vertex);
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      if (i + 1 == spokes.size() && !closed) break;
      const int next = spokes[(i + 1) % spokes.size()];
      if (is_up(spokes[i]) || !is_up(next)) continue;
      TracedArc traced = trace_arc(mesh_, form_, ranks_, spokes[i]);
      const int a = add_arc(std::move(traced.curve), graph_.junctions[j].component);
      Arc& arc = graph_.arcs[a];
      arc.has_upper = arc.has_lower = true;
      arc.from = j;
      arc.to = graph_.junction_of_vertex[mesh_.tail(traced.arrival)];
      arc.lower_start = graph_.junctions[j].sector_of(spokes[i]);
      arc.upper_start = graph_.junctions[j].sector_of(next);
      arc.upper_end = graph_.junctions[arc.to].sector_of(traced.arrival);
      arc.lower_end = following_sector(arc.to, traced.arrival);
    }
  }

  // The sector counter-clockwise after the one of `spoke`, its last spoke.
  int following_sector(int j, int spoke) const {
    const Junction& junction = graph_.junctions[j];
    const auto at = std::find(junction.spokes.begin(), junction.spokes.end(), spoke);
    const std::size_t i = static_cast<std::size_t>(at - junction.spokes.begin());
    return junction.spoke_sector[(i + 1) % junction.spokes.size()];
  }

  void add_loop_arcs(int loop) {
    const std::vector<int>& cycle = mesh_.loops()[loop];
    const int size = static_cast<int>(cycle.size());
    int start = 0;
    while (start < size && graph_.junction_of_vertex[cycle[start]] < 0) ++start;
    if (start == size) {
      add_loop_segment(loop, 0, size);
      return;
    }
    for (int begin = start; begin < start + size;) {
      int end = begin + 1;
      while (graph_.junction_of_vertex[cycle[end % size]] < 0) ++end;
      add_loop_segment(loop, begin, end - begin);
      begin = end;
    }
  }

  // The part of a loop from its vertex `begin` over `count` edges, all with the surface on the same
  // side; turned around where the surface lies below, so that x rises along the arc.
  void add_loop_segment(int loop, int begin, int count) {
    const std::vector<int>& cycle = mesh_.loops()[loop];
    const auto vertex = [&](int i) {
      return cycle[static_cast<std::size_t>(begin + i) % cycle.size()];
    };
    const bool up = ranks_[mesh_.apex(mesh_.outgoing(vertex(0)))] > ranks_[vertex(0)];
    LevelCurve curve;
    curve.x.push_back(0.0);
    for (int i = 0; i < count; ++i) {
      const int h = mesh_.outgoing(vertex(up ? i : count - 1 - i));
      curve.points.push_back(up ? EdgePoint{h, 0.0} : EdgePoint{h, 1.0});
      curve.faces.push_back(Connectivity::face(h));
      curve.x.push_back(curve.x.back() + (up ? 1.0 : -1.0) * form_.dx.along(mesh_, h));
    }
    const int last = mesh_.outgoing(vertex(up ? count - 1 : 0));
    curve.points.push_back({last, up ? 1.0 : 0.0});
    const int a = add_arc(std::move(curve), loop);
    Arc& arc = graph_.arcs[a];
    (up ? arc.has_upper : arc.has_lower) = true;
    for (int i = 0; i < count; ++i) {
      const int index = up ? i : count - i;
      if (graph_.junction_of_vertex[vertex(i)] < 0) {
        graph_.loop_position[vertex(i)] = {a, index == count ? 0 : index};
      }
    }
    attach_to_junctions(arc, vertex(up ? 0 : count), vertex(up ? count : 0), up);
  }

  // On a loop the first sector of a junction lies beside the edge to the next loop vertex, the last
  // one beside the edge from the previous vertex.
  void attach_to_junctions(Arc& arc, int from_vertex, int to_vertex, bool up) {
    arc.from = graph_.junction_of_vertex[from_vertex];
    arc.to = graph_.junction_of_vertex[to_vertex];
    if (arc.from < 0) return;
    const std::vector<int>& from_sectors = graph_.junctions[arc.from].spoke_sector;
    const std::vector<int>& to_sectors = graph_.junctions[arc.to].spoke_sector;
    if (up) {
      arc.upper_start = from_sectors.front();
      arc.upper_end = to_sectors.back();
    } else {
      arc.lower_start = from_sectors.back();
      arc.lower_end = to_sectors.front();
    }
  }

  void link_sectors() {
    for (std::size_t a = 0; a < graph_.arcs.size(); ++a) {
      const Arc& arc = graph_.arcs[a];
      for (const int s : {arc.upper_start, arc.lower_start}) {
        if (s >= 0) graph_.sectors[s].out_arc = static_cast<int>(a);
      }
      for (const int s : {arc.upper_end, arc.lower_end}) {
        if (s >= 0) graph_.sectors[s].in_arc = static_cast<int>(a);
      }
    }
    for (const Sector& s : graph_.sectors) {
      if (s.in_arc < 0 || s.out_arc < 0) {
        throw Error(ExitCode::internal, "a sector of a zero of the form lacks a critical curve");
      }
    }
  }

  void make_arcs_monotone() {
    double longest = 0.0;
    for (const Arc& arc : graph_.arcs) longest = std::max(longest, arc.curve.length());
    for (Arc& arc : graph_.arcs) {
      LevelCurve& curve = arc.curve;
      if (curve.length() < shortest_arc * longest) {
        curve.corrected = true;
        const double step = shortest_arc * longest / static_cast<double>(curve.x.size() - 1);
        for (std::size_t i = 0; i < curve.x.size(); ++i) curve.x[i] = static_cast<double>(i) * step;
      } else {
        curve.corrected = make_monotone(curve.x);
      }
    }
  }

  void collect_crossings() {
    for (std::size_t a = 0; a < graph_.arcs.size(); ++a) {
      const Arc& arc = graph_.arcs[a];
      if (!arc.has_upper || !arc.has_lower) continue;
      for (std::size_t i = 1; i + 1 < arc.curve.points.size(); ++i) {
        graph_.crossings.push_back({mesh_.edge(arc.curve.points[i].halfedge),
                                    graph_.components[arc.component].rank, static_cast<int>(a),
                                    static_cast<int>(i)});
      }
    }
    const auto key = [](const EdgeCrossing& c) { return std::pair{c.edge, c.rank}; };
    std::sort(graph_.crossings.begin(), graph_.crossings.end(),
              [&](const EdgeCrossing& a, const EdgeCrossing& b) { return key(a) < key(b); });
  }

  const Connectivity& mesh_;
  const HolomorphicForm& form_;
  const std::vector<int>& ranks_;
  CriticalGraph graph_;
};

}  // namespace

int Junction::sector_of(int spoke) const {
  const auto at = std::find(spokes.begin(), spokes.end(), spoke);
  return at == spokes.end() ? -1 : spoke_sector[static_cast<std::size_t>(at - spokes.begin())];
}

std::pair<std::size_t, std::size_t> CriticalGraph::crossings_of(int edge) const {
  const auto less = [](const EdgeCrossing& c, int e) { return c.edge < e; };
  const auto first = std::lower_bound(crossings.begin(), crossings.end(), edge, less);
  auto last = first;
  while (last != crossings.end() && last->edge == edge) ++last;
  return {static_cast<std::size_t>(first - crossings.begin()),
          static_cast<std::size_t>(last - crossings.begin())};
}

CriticalGraph critical_graph(const Connectivity& mesh, const HolomorphicForm& form,
                             const std::vector<int>& ranks) {
  return GraphBuilder(mesh, form, ranks).run();
}

}  // namespace hexwall
