#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "inspect/any_mesh.h"
#include "inspect/distribution.h"

namespace hexwall {

/// A measure of the shape of elements. Which shapes have it is said by `cell_metric_value`.
struct CellMetric {
  std::string_view name;
  std::string_view unit;  ///< empty: dimensionless
  bool low_is_bad;        ///< else high is
  Bins bins;
};

/// scaled_jacobian, edge_ratio, aspect_ratio, aspect_frobenius, skew, min_angle, max_angle, volume
/// and area. README.md says what each is.
const std::vector<CellMetric>& cell_metrics();

/// Values of one metric: #E of the elements measured, NaN where an element has none.
using MetricValues = std::vector<double>;

/// All metrics of elements: those of triangles, quads, tetrahedra and hexahedra are Verdict's, as
/// VTK ships them (vtkMeshQuality); Verdict of VTK 9.1 has none for pyramids and wedges, which are
/// measured by the same definitions, scaled such that the ideal shape has 1.
/// \param elements of `mesh`. \returns one list for each of `cell_metrics()`.
std::vector<MetricValues> measure_cells(const AnyMesh& mesh, const std::vector<int>& elements);

/// Values at the corners of the elements' faces: in-plane angles in degrees, and natural logarithms
/// of the ratio of the two edges that meet there (one edge over the next around the face).
struct CornerValues {
  std::vector<double> angle;
  std::vector<double> log_edge_ratio;
};

CornerValues measure_corners(const AnyMesh& mesh, const std::vector<int>& elements);

inline constexpr Bins angle_bins{0.0, 180.0, 36};

/// Symmetric around 0, to the next whole number beyond the values.
Bins log_ratio_bins(const std::vector<double>& values);

}  // namespace hexwall
