#include "quad/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "surface/lanes.h"

namespace hexwall {
namespace {

double corner_angle(const std::array<Vec3, 4>& p, int k) {
  const Vec3 u = p[(k + 1) % 4] - p[k];
  const Vec3 v = p[(k + 3) % 4] - p[k];
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

int count_irregular(const QuadMesh& mesh) {
  std::vector<int> valence(mesh.points.size(), 0);
  for (const auto& quad : mesh.quads) {
    for (const int v : quad) ++valence[v];
  }
  int irregular = 0;
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (mesh.loop_of_vertex[v] < 0 && valence[v] != 4) ++irregular;
  }
  return irregular;
}

std::array<double, 5> edge_quantiles(const QuadMesh& mesh, const std::vector<double>& target) {
  std::vector<double> lengths;
  for (const auto& [a, b] : edges_of(mesh)) {
    const double wanted = 0.5 * (target[a] + target[b]);
    lengths.push_back((mesh.points[a] - mesh.points[b]).norm() / wanted);
  }
  std::sort(lengths.begin(), lengths.end());
  std::array<double, 5> result{};
  const std::array<double, 5> levels{0.01, 0.05, 0.5, 0.95, 0.99};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double rank = levels[i] * static_cast<double>(lengths.size() - 1);
    result[i] = lengths[static_cast<std::size_t>(std::lround(rank))];
  }
  return result;
}

}  // namespace

Vec3 doubled_area_vector(const std::array<Vec3, 4>& p) {
  return (p[2] - p[0]).cross(p[3] - p[1]);
}

double scaled_jacobian(const std::array<Vec3, 4>& p) {
  const VectorLanes corner(p);
  const VectorLanes edge = normalized(next(corner) - corner);
  const VectorLanes normal(Vec3(doubled_area_vector(p).normalized()));
  return std::min(1.0, dot(cross(previous(edge), edge), normal).minCoeff());
}

std::array<Vec3, 4> corners_of(const std::vector<Vec3>& points, const std::array<int, 4>& quad) {
  return {points[quad[0]], points[quad[1]], points[quad[2]], points[quad[3]]};
}

std::array<Vec3, 4> corners_of(const QuadMesh& mesh, int quad) {
  return corners_of(mesh.points, mesh.quads[quad]);
}

std::vector<std::array<int, 2>> edges_of(const QuadMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const QuadEdge& edge : edges_with_quads(mesh)) edges.push_back(edge.vertices);
  return edges;
}

std::vector<QuadEdge> edges_with_quads(const QuadMesh& mesh) {
  // Sides of quads in buckets by their lower vertex: the higher one, and the quad.
  std::vector<int> bucket(mesh.points.size() + 1, 0);
  const auto for_sides = [&](auto visit) {
    for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
      for (int k = 0; k < 4; ++k) {
        const auto [low, high] = std::minmax(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4]);
        visit(low, high, q);
      }
    }
  };
  for_sides([&](int low, int, int) { ++bucket[low + 1]; });
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::array<int, 2>> sides(bucket.back());
  std::vector<int> next(bucket.begin(), bucket.end() - 1);
  for_sides([&](int low, int high, int q) { sides[next[low]++] = {high, q}; });
  std::vector<QuadEdge> edges;
  edges.reserve(sides.size());
  for (int low = 0; low < static_cast<int>(mesh.points.size()); ++low) {
    std::sort(sides.begin() + bucket[low], sides.begin() + bucket[low + 1]);
    for (int i = bucket[low]; i < bucket[low + 1]; ++i) {
      const auto [high, quad] = sides[i];
      if (i > bucket[low] && sides[i - 1][0] == high) {
        edges.back().quads[1] = quad;
      } else {
        edges.push_back({{low, high}, {quad, -1}});
      }
    }
  }
  return edges;
}

std::vector<double> shortest_edges(const QuadMesh& mesh) {
  std::vector<double> shortest(mesh.points.size(), std::numeric_limits<double>::max());
  for (const auto& [a, b] : edges_of(mesh)) {
    const double length = (mesh.points[a] - mesh.points[b]).norm();
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  return shortest;
}

QuadQuality quad_quality(const QuadMesh& mesh, const std::vector<double>& target, double stretch) {
  QuadQuality result;
  result.irregular = count_irregular(mesh);
  double squares = 0.0;
  double largest = 0.0;
  double off_size_area = 0.0;
  for (int q = 0; q < static_cast<int>(mesh.quads.size()); ++q) {
    const auto corners = corners_of(mesh, q);
    result.scaled_jacobian.push_back(scaled_jacobian(corners));
    for (int k = 0; k < 4; ++k) {
      const double off = corner_angle(corners, k) - 0.5 * std::numbers::pi;
      squares += off * off;
    }
    const double quad_area = 0.5 * doubled_area_vector(corners).norm();
    double wanted = 0.0;
    for (const int v : mesh.quads[q]) wanted += 0.25 * target[v];
    const double side = std::sqrt(quad_area / stretch) / wanted;
    result.area += quad_area;
    if (quad_area > largest) {
      largest = quad_area;
      result.largest_quad = q;
    }
    if (side > 2.0 || side < 0.5) off_size_area += quad_area;
  }
  const auto corners = static_cast<double>(4 * mesh.quads.size());
  result.angle_stddev_deg = std::sqrt(squares / corners) * 180.0 / std::numbers::pi;
  result.min_scaled_jacobian =
      *std::min_element(result.scaled_jacobian.begin(), result.scaled_jacobian.end());
  result.edge_length_quantiles = edge_quantiles(mesh, target);
  result.off_size_area_fraction = off_size_area / result.area;
  return result;
}

}  // namespace hexwall
