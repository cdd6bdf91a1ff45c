#include "inspect/distribution.h"

#include <algorithm>
#include <cmath>

namespace hexwall {
namespace {

Histogram histogram_of(const std::vector<double>& values, Bins bins) {
  if (bins.high <= bins.low) {
    bins.low = values.front();
    bins.high = values.back();
  }
  const double width = (bins.high - bins.low) / bins.count;
  // All values are equal, or so far apart that no number says how far: one bin for all.
  if (!(width > 0.0) || !std::isfinite(width)) return {bins.low, 0.0, {values.size()}};
  Histogram histogram{bins.low, width, {}};
  histogram.counts.assign(static_cast<std::size_t>(bins.count), 0);
  for (const double value : values) {
    const double bin = std::floor((value - bins.low) / histogram.width);
    ++histogram.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, bins.count - 1.0))];
  }
  return histogram;
}

}  // namespace

Distribution distribution_of(std::vector<double> values, const Bins& bins) {
  Distribution d;
  if (values.empty()) return d;
  std::sort(values.begin(), values.end());
  d.count = values.size();
  d.min = values.front();
  d.max = values.back();
  for (const double value : values) d.mean += value / static_cast<double>(values.size());
  for (std::size_t i = 0; i < quantile_levels.size(); ++i) {
    const double rank = quantile_levels[i] * static_cast<double>(values.size() - 1);
    d.quantiles[i] = values[static_cast<std::size_t>(std::lround(rank))];
  }
  d.histogram = histogram_of(values, bins);
  return d;
}

}  // namespace hexwall
