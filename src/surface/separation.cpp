#include "surface/separation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

namespace hexwall {
namespace {

using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, int,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

// Below as many boxes CGAL scans them instead of dividing them further: measured.
constexpr std::ptrdiff_t cutoff = 1000;
// As many pairs are looked at together.
constexpr std::size_t batch = std::size_t{1} << 20;
// Of the largest coordinate: rounding is far below it.
constexpr double certain = 1e-10;

/// Corners that two faces have in common.
struct Shared {
  std::array<int, 4> vertices{};
  int count = 0;

  bool has(int v) const {
    return std::find(vertices.begin(), vertices.begin() + count, v) != vertices.begin() + count;
  }
};

Shared shared_corners(std::span<const int> a, std::span<const int> b) {
  Shared shared;
  for (const int v : a) {
    if (std::find(b.begin(), b.end(), v) != b.end()) shared.vertices[shared.count++] = v;
  }
  return shared;
}

}  // namespace

Separation::Separation(const std::vector<Vec3>& points) : points_(points) {
  double largest = 0.0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  gap_ = certain * largest;
}

// The plane lies half way between the centres; through the common vertex or two, if there are, and
// then half way between the directions from there.
bool Separation::is_certain(std::span<const int> a, std::span<const int> b) const {
  const Shared shared = shared_corners(a, b);
  if (shared.count > 2) return false;
  const Vec3& origin = points_[shared.count > 0 ? shared.vertices[0] : a[0]];
  const auto center = [&](std::span<const int> face) {
    Vec3 sum = Vec3::Zero();
    for (const int v : face) sum += points_[v] - origin;
    return Vec3(sum / static_cast<double>(face.size()));
  };
  Vec3 toward_a = center(a);
  Vec3 toward_b = center(b);
  Vec3 edge = Vec3::Zero();
  if (shared.count == 2) edge = (points_[shared.vertices[1]] - origin).normalized();
  const auto across_edge = [&](const Vec3& v) { return Vec3(v - edge.dot(v) * edge); };
  toward_a = across_edge(toward_a);
  toward_b = across_edge(toward_b);
  if (shared.count > 0) {
    toward_a.normalize();
    toward_b.normalize();
  }
  // Once more: on needles, normalising has magnified what rounding left along the edge.
  Vec3 normal = across_edge(toward_a - toward_b);
  if (shared.count == 0) normal.normalize();
  double least_of_a = std::numeric_limits<double>::max();
  double most_of_b = std::numeric_limits<double>::lowest();
  for (const int v : a) {
    if (!shared.has(v)) least_of_a = std::min(least_of_a, normal.dot(points_[v] - origin));
  }
  for (const int v : b) {
    if (!shared.has(v)) most_of_b = std::max(most_of_b, normal.dot(points_[v] - origin));
  }
  if (shared.count == 0) return least_of_a - most_of_b > gap_;
  return least_of_a > gap_ && most_of_b < -gap_;
}

void for_box_pairs(const std::vector<Eigen::AlignedBox3d>& boxes,
                   const std::function<void(const std::vector<std::pair<int, int>>&)>& look) {
  std::vector<Box> list;
  list.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) {
    const Vec3& low = box.min();
    const Vec3& high = box.max();
    list.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                      static_cast<int>(list.size()));
  }
  std::vector<const Box*> order;
  order.reserve(list.size());
  for (const Box& box : list) order.push_back(&box);
  std::vector<std::pair<int, int>> pairs;
  CGAL::box_self_intersection_d(
      order.begin(), order.end(),
      [&](const Box* a, const Box* b) {
        pairs.emplace_back(std::min(a->info(), b->info()), std::max(a->info(), b->info()));
        if (pairs.size() < batch) return;
        look(pairs);
        pairs.clear();
      },
      cutoff);
  look(pairs);
}

}  // namespace hexwall
