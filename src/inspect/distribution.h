#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hexwall {

/// How often values occur: `counts[i]` of them from `low + i width` to `low + (i + 1) width`. The
/// first and the last bin hold what lies beyond as well.
struct Histogram {
  double low = 0.0, width = 0.0;
  std::vector<std::size_t> counts;
};

inline constexpr std::array<double, 5> quantile_levels{0.01, 0.05, 0.5, 0.95, 0.99};

/// What values are like.
struct Distribution {
  std::size_t count = 0;
  double min = 0.0, max = 0.0, mean = 0.0;
  std::array<double, quantile_levels.size()> quantiles{};
  Histogram histogram;
};

/// The bins of a histogram; without `high > low` they span the values.
struct Bins {
  double low = 0.0, high = 0.0;
  int count = 20;
};

/// \pre no value is NaN.
Distribution distribution_of(std::vector<double> values, const Bins& bins = {});

}  // namespace hexwall
