#pragma once

#include <vector>

#include "flow/read_run.h"

namespace hexwall {

/// Wall shear stress on the faces of a wall, in Pa.
struct WallShear {
  std::vector<Vec3> stress;       ///< #faces, at the last time; along the flow
  std::vector<double> magnitude;  ///< #faces, of `stress`
  /// Means over the cycles that were averaged, empty where the run has none:
  std::vector<double> tawss;  ///< #faces: mean of the magnitude
  std::vector<double> osi;    ///< #faces: (1 - |mean of the vector| / tawss) / 2, from 0 to 0.5
  std::vector<double> rrt;    ///< #faces: 1 / ((1 - 2 osi) tawss), in 1/Pa
};

/// Oscillatory shear index: He and Ku, J Biomech Eng 118:74, 1996; relative residence time:
/// Himburg et al., Am J Physiol 286:H1916, 2004. Where the stress vanishes osi is 0; rrt is bounded
/// by osi ≤ 0.4999 and by a tawss of at least 1e-6 Pa.
/// \param density kg/m³
WallShear wall_shear(const RunWall& wall, double density);

/// Of values on faces, weighted by the faces' areas.
struct AreaStatistics {
  double mean = 0.0;
  double least = 0.0;
  double greatest = 0.0;
  std::vector<double> percentiles;  ///< at `kPercentiles`
};
inline constexpr int kPercentiles[] = {1, 5, 25, 50, 75, 95, 99};

/// \param values, areas #faces, at least one; areas not negative, not all 0
AreaStatistics area_statistics(const std::vector<double>& values, const std::vector<double>& areas);

/// Share of the area where the value is below `threshold`.
double area_fraction_below(const std::vector<double>& values, const std::vector<double>& areas,
                           double threshold);

}  // namespace hexwall
