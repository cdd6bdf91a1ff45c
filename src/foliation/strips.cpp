#include "foliation/strips.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/errors.h"

namespace hexwall {
namespace {

// A vertical line met when walking around a circle.
struct Stop {
  int line;
  double x;      // coordinate on the circle
  int arc;       // arc that follows, or that it lies on
  int interval;  // of that arc, between this line and the next
  int item;      // index in the arc's lines, -1 for a line that starts at the junction there
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

class StripFinder {
 public:
  StripFinder(const CriticalGraph& graph, const std::vector<Cylinder>& cylinders)
      : graph_(graph), cylinders_(cylinders), line_of_sector_(graph.sectors.size()) {
    result_.arc_lines.resize(graph.arcs.size());
    for (std::size_t s = 0; s < graph.sectors.size(); ++s) {
      line_of_sector_[s] = static_cast<int>(result_.lines.size());
      result_.lines.push_back({static_cast<int>(s), graph.sectors[s].is_upper});
    }
  }

  Strips run() {
    cut_plain_annulus();
    for (const int c : cylinders_by_rank(false)) drop_falling_lines(cylinders_[c]);
    for (const int c : cylinders_by_rank(true)) raise_rising_lines(cylinders_[c]);
    collect_cylinders();
    join_strips();
    return std::move(result_);
  }

 private:
  const Arc& arc(int a) const { return graph_.arcs[a]; }

  // Without zeros there is one cylinder and no critical trajectory: any vertical line will do.
  void cut_plain_annulus() {
    if (!graph_.sectors.empty()) return;
    result_.lines.push_back({-1, false});
    result_.arc_lines[cylinders_.front().top_circle.arcs.front()].push_back({0, 0.0});
  }

  // From the lowest bottom circle up, or from the highest top circle down.
  std::vector<int> cylinders_by_rank(bool rising) const {
    std::vector<int> order(cylinders_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](int c) {
      return rising ? graph_.components[cylinders_[c].bottom].rank
                    : -graph_.components[cylinders_[c].top].rank;
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
    return order;
  }

  // The lines on a circle, seen from the cylinder above it (`upper`) or below it.
  std::vector<Stop> stops(const Circle& circle, bool upper) const {
    std::vector<Stop> result;
    for (std::size_t i = 0; i < circle.arcs.size(); ++i) {
      const int a = circle.arcs[i];
      int interval = 0;
      if (!arc(a).is_plain_loop()) {
        const int sector = upper ? arc(a).upper_start : arc(a).lower_start;
        result.push_back({line_of_sector_[sector], circle.start[i], a, interval++, -1});
      }
      int item = 0;
      for (const LineOnArc& on_arc : result_.arc_lines[a]) {
        result.push_back({on_arc.line, circle.start[i] + on_arc.offset, a, interval++, item++});
      }
    }
    return result;
  }

  // Places lines, given in cyclic order by coordinates on `from`, on the arcs of `to`.
  void place(const std::vector<Stop>& lines, const Circle& from, const Circle& to, double shift) {
    if (lines.empty()) return;
    const double scale = to.length / from.length;
    double first = std::fmod((lines.front().x + shift) * scale, to.length);
    if (first < 0.0) first += to.length;
    // Those that wrap around come first on their arcs.
    for (const bool wrapped : {true, false}) {
      for (const Stop& stop : lines) {
        const double x = first + (stop.x - lines.front().x) * scale;
        if ((x >= to.length) == wrapped) place_one(stop.line, wrapped ? x - to.length : x, to);
      }
    }
  }

  void place_one(int line, double x, const Circle& circle) {
    const auto after = std::upper_bound(circle.start.begin() + 1, circle.start.end(), x);
    const auto i = static_cast<std::size_t>(after - circle.start.begin()) - 1;
    const int a = circle.arcs[i];
    const double least = result_.arc_lines[a].empty() ? 0.0 : result_.arc_lines[a].back().offset;
    const double offset = std::clamp(x - circle.start[i], 0.0, arc(a).curve.length());
    result_.arc_lines[a].push_back({line, std::max(least, offset)});
  }

  void drop_falling_lines(const Cylinder& c) {
    place(stops(c.top_circle, false), c.top_circle, c.bottom_circle, -c.twist);
  }

  void raise_rising_lines(const Cylinder& c) {
    std::vector<Stop> bottom = stops(c.bottom_circle, true);
    const std::vector<Stop> top = stops(c.top_circle, false);
    if (top.empty()) {  // a plain loop that only rising lines reach
      place(bottom, c.bottom_circle, c.top_circle, c.twist);
      return;
    }
    // Both lists start with the same falling line, so that each rising line follows one.
    const auto first = bottom.begin() + (find_line(bottom, top.front().line) - bottom.cbegin());
    for (auto it = bottom.begin(); it != first; ++it) it->x += c.bottom_circle.length;
    std::rotate(bottom.begin(), first, bottom.end());
    insert_rising_lines(bottom, top, c.top_circle.length / c.bottom_circle.length);
  }

  void insert_rising_lines(const std::vector<Stop>& bottom, const std::vector<Stop>& top,
                           double scale) {
    std::vector<std::vector<LineOnArc>> merged(result_.arc_lines.size());
    std::size_t b = 0;
    for (const Stop& anchor : top) {
      std::vector<LineOnArc>& lines = merged[anchor.arc];
      const double start = anchor.item < 0 ? 0.0 : offset_of(anchor);
      const double end = end_of_gap(anchor);
      const double origin = bottom[b].x;
      if (anchor.item >= 0) lines.push_back({anchor.line, start});
      double least = start;
      for (++b; b < bottom.size() && result_.lines[bottom[b].line].rising; ++b) {
        least = std::clamp(start + (bottom[b].x - origin) * scale, least, end);
        lines.push_back({bottom[b].line, least});
      }
    }
    for (const Stop& stop : top) {
      if (!merged[stop.arc].empty()) result_.arc_lines[stop.arc] = std::move(merged[stop.arc]);
    }
  }

  static std::vector<Stop>::const_iterator find_line(const std::vector<Stop>& list, int line) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Stop& s) { return s.line == line; });
    if (found == list.end()) throw Error(ExitCode::internal, "a critical trajectory was lost");
    return found;
  }

  double offset_of(const Stop& stop) const { return result_.arc_lines[stop.arc][stop.item].offset; }

  double end_of_gap(const Stop& stop) const {
    const auto& lines = result_.arc_lines[stop.arc];
    const int next = stop.item + 1;
    return next < static_cast<int>(lines.size()) ? lines[next].offset
                                                 : arc(stop.arc).curve.length();
  }

  void collect_cylinders();
  void join_strips();

  const CriticalGraph& graph_;
  const std::vector<Cylinder>& cylinders_;
  std::vector<int> line_of_sector_;
  Strips result_;
  // Per cylinder, the interval of each strip on the bottom and on the top circle.
  std::vector<std::vector<std::pair<Stop, Stop>>> pairs_;
};

void StripFinder::collect_cylinders() {
  for (const Cylinder& c : cylinders_) {
    const std::vector<Stop> bottom = stops(c.bottom_circle, true);
    std::vector<Stop> top = stops(c.top_circle, false);
    const auto first = find_line(top, bottom.front().line);
    const auto shift = first - top.cbegin();
    for (auto it = top.begin(); it != top.begin() + shift; ++it) it->x += c.top_circle.length;
    std::rotate(top.begin(), top.begin() + shift, top.end());
    // Lift x on the top circle to the turn that lies next to the bottom circle's.
    const double scale = c.bottom_circle.length / c.top_circle.length;
    const double raw = (top.front().x - c.twist) * scale - bottom.front().x;
    const double turn = std::round(raw / c.circumference()) * c.circumference();
    std::vector<LineInCylinder> lines;
    std::vector<std::pair<Stop, Stop>> pairs;
    for (std::size_t i = 0; i < bottom.size(); ++i) {
      if (i >= top.size() || bottom[i].line != top[i].line) {
        throw Error(ExitCode::internal, "vertical critical trajectories cross each other");
      }
      const double x_top = (top[i].x - c.twist) * scale - turn;
      lines.push_back({bottom[i].line, bottom[i].x, x_top, -1, top[i].arc, top[i].interval});
      pairs.emplace_back(bottom[i], top[i]);
    }
    result_.in_cylinder.push_back(std::move(lines));
    pairs_.push_back(std::move(pairs));
  }
}

void StripFinder::join_strips() {
  std::vector<int> first_interval(graph_.arcs.size() + 1, 0);
  for (std::size_t a = 0; a < graph_.arcs.size(); ++a) {
    const std::size_t intervals =
        result_.arc_lines[a].size() + (graph_.arcs[a].is_plain_loop() ? 0 : 1);
    first_interval[a + 1] = first_interval[a] + static_cast<int>(intervals);
  }
  const auto interval = [&](const Stop& s) { return first_interval[s.arc] + s.interval; };
  UnionFind sets(first_interval.back());
  for (const auto& pairs : pairs_) {
    for (const auto& [bottom, top] : pairs) sets.join(interval(bottom), interval(top));
  }
  std::vector<int> strip(first_interval.back(), -1);
  for (int i = 0; i < first_interval.back(); ++i) {
    if (sets.root(i) == i) {
      strip[i] = result_.count();
      result_.width.push_back(0.0);
    } else {
      strip[i] = strip[sets.root(i)];
    }
  }
  result_.arc_strips.resize(graph_.arcs.size());
  for (std::size_t a = 0; a < graph_.arcs.size(); ++a) {
    for (int i = first_interval[a]; i < first_interval[a + 1]; ++i) {
      result_.arc_strips[a].push_back(strip[i]);
    }
  }
  for (std::size_t c = 0; c < cylinders_.size(); ++c) {
    auto& lines = result_.in_cylinder[c];
    for (std::size_t i = 0; i < lines.size(); ++i) {
      lines[i].strip = strip[interval(pairs_[c][i].first)];
      const double end = i + 1 < lines.size() ? lines[i + 1].x_bottom
                                              : lines[0].x_bottom + cylinders_[c].circumference();
      // The widest crossing: they differ by rounding only, unless an arc had to be corrected.
      double& width = result_.width[lines[i].strip];
      width = std::max(width, end - lines[i].x_bottom);
    }
  }
}

}  // namespace

Strips find_strips(const CriticalGraph& graph, const std::vector<Cylinder>& cylinders) {
  return StripFinder(graph, cylinders).run();
}

}  // namespace hexwall
