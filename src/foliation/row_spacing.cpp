#include "foliation/row_spacing.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace hexwall {
namespace {

// Samples per cylinder: two a row, and enough that a single tall row sees a varying scale.
constexpr int fewest_samples = 16;
constexpr int most_samples = 2000;

double interpolate(const std::vector<double>& from, const std::vector<double>& to, double value) {
  const auto upper = std::upper_bound(from.begin() + 1, from.end() - 1, value);
  const auto i = static_cast<std::size_t>(upper - from.begin()) - 1;
  const double width = from[i + 1] - from[i];
  const double t = width > 0.0 ? std::clamp((value - from[i]) / width, 0.0, 1.0) : 0.0;
  return (1.0 - t) * to[i] + t * to[i + 1];
}

// Root mean square over a level curve, in x.
double mean_size_ratio(const TriangleSurface& surface, const Connectivity& mesh,
                       const LevelCurve& curve, const FaceScales& scales) {
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < curve.faces.size(); ++i) {
    const double length =
        (position(surface, mesh, curve.points[i + 1]) - position(surface, mesh, curve.points[i]))
            .norm();
    const int f = curve.faces[i];
    sum += length * scales.factor[f] * scales.size_ratio[f] * scales.size_ratio[f];
    total += length * scales.factor[f];
  }
  return std::sqrt(sum / total);
}

}  // namespace

double RowSpacing::rows_below(double y_value) const {
  return interpolate(y, rows, y_value);
}

double RowSpacing::y_of(double row) const {
  return interpolate(rows, y, row);
}

std::vector<RowSpacing> space_rows(const TriangleSurface& surface, const Connectivity& mesh,
                                   const HolomorphicForm& form, const FaceScales& scales,
                                   const std::vector<Cylinder>& cylinders,
                                   const RowSpacingOptions& options) {
  std::vector<RowSpacing> result(cylinders.size());
  parallel_tasks(cylinders.size(), [&](std::size_t c) {
    const Cylinder& cylinder = cylinders[c];
    RowSpacing& spacing = result[c];
    spacing.y = {cylinder.y_bottom};
    spacing.rows = {0.0};
    const double conformal_rows = cylinder.height() / options.size_in_plane;
    const int samples =
        std::clamp(static_cast<int>(2.0 * conformal_rows), fewest_samples, most_samples);
    for (int i = 0; i < samples; ++i) {
      const double y = cylinder.y_bottom + cylinder.height() * (i + 0.5) / samples;
      double density = 1.0;
      if (options.evenness > 0.0 && cylinder.y_bottom < y && y < cylinder.y_top) {
        const LevelCurve curve = level_curve(mesh, form, cylinder, y);
        const double ratio = mean_size_ratio(surface, mesh, curve, scales);
        density = std::pow(ratio, options.evenness);
      }
      spacing.y.push_back(cylinder.y_bottom + cylinder.height() * (i + 1) / samples);
      spacing.rows.push_back(spacing.rows.back() + density * conformal_rows / samples);
    }
    spacing.y.back() = cylinder.y_top;
  });
  return result;
}

}  // namespace hexwall
