#include "quad/quantise.h"

#include <algorithm>
#include <cmath>

namespace hexwall {
namespace {

// Circumferences matter more than single strips: an error there is seen all around the vessel.
constexpr double circumference_weight = 4.0;
// A circle short of quads is worse than any rounding error.
constexpr double shortage_weight = 1e3;

double squared_error(int count, double target) {
  const double difference = count - target;
  return difference * difference / (target + 1.0);
}

class StripRounding {
 public:
  StripRounding(const std::vector<Cylinder>& cylinders, const Strips& strips,
                const std::vector<RowSpacing>& spacing, const QuantiseOptions& options)
      : fewest_(options.fewest_around),
        cylinders_of_strip_(strips.width.size()),
        strip_target_(strips.width.size(), 0.0) {
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
    return across_;
  }

 private:
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
    return sum;
  }

  int fewest_;
  std::vector<std::vector<int>> cylinders_of_strip_;
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

Quantisation quantise(const std::vector<Cylinder>& cylinders, const Strips& strips,
                      const std::vector<RowSpacing>& spacing, const QuantiseOptions& options) {
  Quantisation result;
  result.across = StripRounding(cylinders, strips, spacing, options).run();
  for (const RowSpacing& rows : spacing) {
    result.along.push_back(std::max(1, static_cast<int>(std::lround(rows.wanted()))));
  }
  return result;
}

}  // namespace hexwall
