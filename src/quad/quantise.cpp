#include "quad/quantise.h"

#include <algorithm>
#include <cmath>

namespace hexwall {
namespace {

// Circumferences matter more than single strips: an error there is seen all around the vessel.
constexpr double circumference_weight = 4.0;
// A circle short of quads, or a pole that can't be closed, is worse than any rounding error.
constexpr double shortage_weight = 1e3;
constexpr int pole_multiple = 4;
// Quads along an opening. A loop of half-zeros is the end of no cylinder, which has more; with two
// its edges would be the same edge, and the opening closed.
constexpr int fewest_along_loop = 3;

double squared_error(int count, double target) {
  const double difference = count - target;
  return difference * difference / (target + 1.0);
}

// Strips that start or end on a loop.
std::vector<int> strips_of_loop(const Foliation& foliation, int loop) {
  std::vector<int> strips;
  for (const int a : foliation.graph.components[loop].arcs) {
    const Arc& arc = foliation.graph.arcs[a];
    if (arc.has_upper && arc.has_lower) continue;  // leaves a half-zero, inside the surface
    const auto& crossing = foliation.strips.arc_strips[a];
    strips.insert(strips.end(), crossing.begin(), crossing.end());
  }
  return strips;
}

class StripRounding {
 public:
  StripRounding(const Foliation& foliation, const std::vector<RowSpacing>& spacing,
                const QuantiseOptions& options)
      : fewest_(options.fewest_around),
        cylinders_of_strip_(foliation.strips.width.size()),
        loops_of_strip_(foliation.strips.width.size()),
        strip_target_(foliation.strips.width.size(), 0.0) {
    const std::vector<Cylinder>& cylinders = foliation.cylinders;
    const Strips& strips = foliation.strips;
    find_loops(foliation, options.poles);
    for (std::size_t c = 0; c < cylinders.size(); ++c) {
      // As dense around as along, so that quads are square in the (x, y) plane.
      const double height = cylinders[c].height();
      const double density = height > 0.0 ? spacing[c].wanted() / height : 1.0 / options.size;
      around_target_.push_back(cylinders[c].circumference() * density);
      for (const LineInCylinder& line : strips.in_cylinder[c]) {
        cylinders_of_strip_[line.strip].push_back(static_cast<int>(c));
      }
    }
    set_strip_targets(cylinders, spacing, strips.width, options.size);
    around_.assign(cylinders.size(), 0);
    for (std::size_t s = 0; s < strip_target_.size(); ++s) {
      across_.push_back(std::max(1, static_cast<int>(std::lround(strip_target_[s]))));
      for (const int c : cylinders_of_strip_[s]) around_[c] += across_.back();
    }
  }

  std::vector<int> run() {
    while (improve()) {
    }
    for (std::size_t loop = 0; loop < is_pole_.size(); ++loop) {
      if (is_pole_[loop] && excess(static_cast<int>(loop)) != 0) pass_on(static_cast<int>(loop));
    }
    return across_;
  }

 private:
  void find_loops(const Foliation& foliation, const std::vector<int>& poles) {
    for (int loop = 0; foliation.graph.components[loop].loop == loop;) {
      strips_of_loop_.push_back(strips_of_loop(foliation, loop));
      for (const int s : strips_of_loop_.back()) loops_of_strip_[s].push_back(loop);
      if (++loop == static_cast<int>(foliation.graph.components.size())) break;
    }
    is_pole_.assign(strips_of_loop_.size(), false);
    for (const int loop : poles) is_pole_[loop] = true;
  }

  int along_loop(int loop) const {
    int sum = 0;
    for (const int s : strips_of_loop_[loop]) sum += across_[s];
    return sum;
  }

  // Quads around a loop beyond the last multiple of four.
  int excess(int loop) const { return along_loop(loop) % pole_multiple; }

  // Takes the excess of a pole off the strips along a way to a loop that is no pole, in turns less
  // and more, so that the poles on the way keep their numbers.
  void pass_on(int pole) {
    std::vector<int> arrival(strips_of_loop_.size(), -1);
    std::vector<int> queue{pole};
    std::size_t i = 0;
    while (is_pole_[queue[i]]) {
      for (const int s : strips_of_loop_[queue[i]]) {
        for (const int next : loops_of_strip_[s]) {
          if (next == pole || arrival[next] >= 0) continue;
          arrival[next] = s;
          queue.push_back(next);
        }
      }
      ++i;
    }
    std::vector<int> way;
    for (int loop = queue[i]; loop != pole; loop = other_loop(arrival[loop], loop)) {
      way.push_back(arrival[loop]);
    }
    int change = excess(pole) <= pole_multiple / 2 ? -excess(pole) : pole_multiple - excess(pole);
    for (auto strip = way.rbegin(); strip != way.rend(); ++strip, change = -change) {
      shift(*strip, can_shift(*strip, change) ? change : change + pole_multiple);
    }
  }

  bool can_shift(int strip, int change) const {
    const std::vector<int>& loops = loops_of_strip_[strip];
    return across_[strip] + change >= 1 && std::all_of(loops.begin(), loops.end(), [&](int loop) {
             return is_pole_[loop] || along_loop(loop) + change >= fewest_along_loop;
           });
  }

  int other_loop(int strip, int loop) const {
    const std::vector<int>& ends = loops_of_strip_[strip];
    return ends[0] == loop ? ends[1] : ends[0];
  }

  // A strip is as dense as the cylinders that it crosses, on the mean over its length.
  void set_strip_targets(const std::vector<Cylinder>& cylinders,
                         const std::vector<RowSpacing>& spacing, const std::vector<double>& width,
                         double size) {
    for (std::size_t s = 0; s < width.size(); ++s) {
      double rows = 0.0;
      double height = 0.0;
      for (const int c : cylinders_of_strip_[s]) {
        rows += spacing[c].wanted();
        height += cylinders[c].height();
      }
      strip_target_[s] = width[s] * (height > 0.0 ? rows / height : 1.0 / size);
    }
  }

  // Applies the best step of +-1 on one strip, or of +1 and -1 on two.
  bool improve() {
    const int count = static_cast<int>(across_.size());
    Step best;
    for (int s = 0; s < count; ++s) {
      consider({s, 1, -1}, best);
      consider({s, -1, -1}, best);
      for (int t = 0; t < count; ++t) {
        if (t != s) consider({s, 1, t}, best);
      }
    }
    if (best.strip < 0) return false;
    apply(best, 1);
    return true;
  }

  struct Step {
    int strip = -1;
    int change = 0;
    int partner = -1;    // changes the other way
    double gain = 1e-9;  // least gain worth a step: keeps rounding noise from cycling
  };

  void apply(const Step& step, int sign) {
    shift(step.strip, sign * step.change);
    if (step.partner >= 0) shift(step.partner, -sign * step.change);
  }

  void shift(int strip, int change) {
    across_[strip] += change;
    for (const int c : cylinders_of_strip_[strip]) around_[c] += change;
  }

  void consider(Step step, Step& best) {
    const double before = cost(step);
    apply(step, 1);
    const bool valid = across_[step.strip] >= 1 && (step.partner < 0 || across_[step.partner] >= 1);
    step.gain = valid ? before - cost(step) : 0.0;
    apply(step, -1);
    if (step.gain > best.gain) best = step;
  }

  // The part of the cost that a step can change (a cylinder of both strips counts twice: harmless,
  // its number does not change).
  double cost(const Step& step) const {
    double sum = strip_cost(step.strip);
    if (step.partner >= 0) sum += strip_cost(step.partner);
    return sum;
  }

  double strip_cost(int strip) const {
    double sum = squared_error(across_[strip], strip_target_[strip]);
    for (const int c : cylinders_of_strip_[strip]) {
      sum += circumference_weight * squared_error(around_[c], around_target_[c]);
      const int missing = std::max(0, fewest_ - around_[c]);
      sum += shortage_weight * missing * missing;
    }
    for (const int loop : loops_of_strip_[strip]) {
      if (is_pole_[loop]) {
        sum += shortage_weight * std::min(excess(loop), pole_multiple - excess(loop));
      }
      const int missing = std::max(0, fewest_along_loop - along_loop(loop));
      sum += shortage_weight * missing * missing;
    }
    return sum;
  }

  int fewest_;
  std::vector<std::vector<int>> cylinders_of_strip_;
  std::vector<std::vector<int>> strips_of_loop_;
  std::vector<std::vector<int>> loops_of_strip_;  // where each strip starts and ends
  std::vector<bool> is_pole_;                     // per loop
  std::vector<double> strip_target_, around_target_;
  std::vector<int> across_, around_;
};

}  // namespace

int Quantisation::around(const Strips& strips, int cylinder) const {
  int sum = 0;
  for (const LineInCylinder& line : strips.in_cylinder[cylinder]) sum += across[line.strip];
  return sum;
}

long Quantisation::quad_count(const Strips& strips) const {
  long sum = 0;
  for (std::size_t c = 0; c < along.size(); ++c) {
    sum += static_cast<long>(along[c]) * around(strips, static_cast<int>(c));
  }
  return sum;
}

Quantisation quantise(const Foliation& foliation, const std::vector<RowSpacing>& spacing,
                      const QuantiseOptions& options) {
  Quantisation result;
  result.across = StripRounding(foliation, spacing, options).run();
  for (const RowSpacing& rows : spacing) {
    const long count = std::lround(rows.wanted() / options.stretch);
    result.along.push_back(std::max(1, static_cast<int>(count)));
  }
  return result;
}

}  // namespace hexwall
