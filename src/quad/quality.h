#pragma once

#include <array>
#include <vector>

#include "quad/quad_mesh.h"

namespace hexwall {

/// Scaled Jacobian of a quad in space: the least over its corners of the sine of the corner angle,
/// signed by the quad's mean normal (Verdict's definition). 1 for a rectangle, <= 0 when inverted.
double scaled_jacobian(const std::array<Vec3, 4>& corners);

/// Corner positions of a quad.
std::array<Vec3, 4> corners_of(const std::vector<Vec3>& points, const std::array<int, 4>& quad);
std::array<Vec3, 4> corners_of(const QuadMesh& mesh, int quad);

/// Doubled area vector of a quad: half the cross product of its diagonals, times two.
Vec3 doubled_area_vector(const std::array<Vec3, 4>& corners);

struct QuadQuality {
  int irregular = 0;              ///< interior vertices of valence other than 4
  double angle_stddev_deg = 0.0;  ///< root mean square of corner angle - 90 degrees
  double min_scaled_jacobian = 0.0;
  std::vector<double> scaled_jacobian;            ///< #Q
  std::array<double, 5> edge_length_quantiles{};  ///< 1, 5, 50, 95, 99 %, relative to the target
  double area = 0.0;                              ///< of all quads
  int largest_quad = -1;                          ///< the quad of greatest area
  double off_size_area_fraction = 0.0;  ///< share of the area in quads more than 2x off in size
};

/// \param target #V edge length wanted at each vertex, in the mesh's length unit: of the shorter
/// edges if quads longer than wide are wanted. \param stretch wanted length over width.
QuadQuality quad_quality(const QuadMesh& mesh, const std::vector<double>& target,
                         double stretch = 1.0);

/// Distinct edges as vertex pairs, the lower number first, in lexicographic order.
std::vector<std::array<int, 2>> edges_of(const QuadMesh& mesh);

/// An edge with the quads beside it.
struct QuadEdge {
  std::array<int, 2> vertices;  ///< the lower number first
  std::array<int, 2> quads;     ///< on both sides in ascending order, the second -1 on a loop
};

/// The same edges. \pre manifold.
std::vector<QuadEdge> edges_with_quads(const QuadMesh& mesh);

/// #V Length of the shortest edge at each vertex.
std::vector<double> shortest_edges(const QuadMesh& mesh);

}  // namespace hexwall
