#include "flow/wall_shear.h"

#include <algorithm>
#include <numeric>

namespace hexwall {
namespace {

constexpr double greatest_osi = 0.4999;
constexpr double least_tawss = 1e-6;

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

WallShear wall_shear(const RunWall& wall, double density) {
  WallShear result;
  for (const Vec3& stress : wall.shear) {
    // OpenFOAM gives the force of the wall on the fluid.
    result.stress.emplace_back(-density * stress);
    result.magnitude.push_back(density * stress.norm());
  }
  if (wall.mean_magnitude.size() != wall.faces.size() ||
      wall.mean_shear.size() != wall.faces.size()) {
    return result;
  }
  for (std::size_t f = 0; f < wall.faces.size(); ++f) {
    const double tawss = density * wall.mean_magnitude[f];
    const double of_mean = density * wall.mean_shear[f].norm();
    const double osi = tawss > 0.0 ? std::clamp(0.5 * (1.0 - of_mean / tawss), 0.0, 0.5) : 0.0;
    result.tawss.push_back(tawss);
    result.osi.push_back(osi);
    result.rrt.push_back(
        1.0 / ((1.0 - 2.0 * std::min(osi, greatest_osi)) * std::max(tawss, least_tawss)));
  }
  return result;
}

AreaStatistics area_statistics(const std::vector<double>& values,
                               const std::vector<double>& areas) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double total = sum(areas);
  AreaStatistics result;
  result.mean = std::inner_product(values.begin(), values.end(), areas.begin(), 0.0) / total;
  result.least = values[order.front()];
  result.greatest = values[order.back()];
  double below = 0.0;
  auto at = order.begin();
  for (const int percent : kPercentiles) {
    while (at + 1 != order.end() && below + areas[*at] < total * percent / 100.0)
      below += areas[*at++];
    result.percentiles.push_back(values[*at]);
  }
  return result;
}

double area_fraction_below(const std::vector<double>& values, const std::vector<double>& areas,
                           double threshold) {
  double below = 0.0;
  for (std::size_t f = 0; f < values.size(); ++f)
    if (values[f] < threshold) below += areas[f];
  return below / sum(areas);
}

}  // namespace hexwall
