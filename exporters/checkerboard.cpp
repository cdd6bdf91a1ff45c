#include "exporters/checkerboard.h"

#include <cmath>
#include <utility>
#include <vector>

#include "exporters/results.h"

namespace hexwall {
namespace {

constexpr double tiles = 3000.0;  ///< on the whole surface, if they were as large as wanted

// Lengths of the loops; the start of the descent has these as circumferences.
std::vector<double> loop_lengths(const FormSolution& s) {
  std::vector<double> lengths;
  for (const auto& loop : s.connectivity.loops()) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto& points = s.refined.surface.points;
      length += (points[loop[(i + 1) % loop.size()]] - points[loop[i]]).norm();
    }
    lengths.push_back(length);
  }
  return lengths;
}

PolyData board(const PipelineResult& r, const LaplaceSolver& laplace, Eigen::VectorXd lambda) {
  const FormSolution& s = r.solution;
  const double tile = std::sqrt(total_area(s.refined.surface) / tiles);
  for (double& period : lambda) {
    const double pairs = std::max(1.0, std::round(std::abs(period) / (2.0 * tile)));
    period = std::copysign(2.0 * tile * pairs, period);
  }
  const HolomorphicForm form = combine(s.connectivity, laplace, s.basis, lambda);
  std::vector<double> uv = form_at_corners(s, form);
  for (double& x : uv) x /= tile;
  PolyData data = separate_triangles(s.refined.surface);
  data.point_arrays.push_back({"uv", 2, std::move(uv)});
  data.texture_coordinates = "uv";
  return data;
}

}  // namespace

Checkerboards checkerboards(const PipelineResult& r) {
  const FormSolution& s = r.solution;
  const Descent& best = s.optimum.descents[s.optimum.best];
  const Eigen::VectorXd start = balanced_start(best.signs, loop_lengths(s), s.basis.exterior);
  const auto laplace = laplace_of(s);
  return {board(r, *laplace, start), board(r, *laplace, s.optimum.lambda), best.iterations.front()};
}

}  // namespace hexwall
