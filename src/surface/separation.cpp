#include "surface/separation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <CGAL/Bbox_3.h>
#include <CGAL/box_intersection_d.h>

#include "core/parallel.h"

namespace hexwall {
namespace {

using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, int,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

// Below as many boxes CGAL scans them instead of dividing them further: measured.
constexpr std::ptrdiff_t cutoff = 1000;
// About as many boxes begin in a slab.
constexpr std::size_t boxes_per_slab = 4096;
// Of the largest coordinate: rounding is far below it.
constexpr double certain = 1e-10;

/// Divides space across its longest axis so that about as many boxes begin in each slab.
class Slabs {
 public:
  explicit Slabs(const std::vector<Eigen::AlignedBox3d>& boxes) {
    Eigen::AlignedBox3d all;
    for (const Eigen::AlignedBox3d& box : boxes) all.extend(box);
    if (!boxes.empty()) all.sizes().maxCoeff(&axis_);
    std::vector<double> begins;
    begins.reserve(boxes.size());
    for (const Eigen::AlignedBox3d& box : boxes) begins.push_back(box.min()[axis_]);
    const std::size_t count = 1 + boxes.size() / boxes_per_slab;
    for (std::size_t slab = 1; slab < count; ++slab) {
      const auto cut = begins.begin() + static_cast<std::ptrdiff_t>(slab * begins.size() / count);
      std::nth_element(begins.begin(), cut, begins.end());
      cuts_.push_back(*cut);
    }
  }

  /// The slab in which a box begins.
  std::size_t first(const Eigen::AlignedBox3d& box) const { return slab_of(box.min()[axis_]); }

  /// The boxes that reach into each slab.
  std::vector<std::vector<int>> members(const std::vector<Eigen::AlignedBox3d>& boxes) const {
    std::vector<std::vector<int>> result(cuts_.size() + 1);
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
      const std::size_t last = slab_of(boxes[i].max()[axis_]);
      for (std::size_t slab = first(boxes[i]); slab <= last; ++slab) result[slab].push_back(i);
    }
    return result;
  }

 private:
  std::size_t slab_of(double x) const {
    return std::upper_bound(cuts_.begin(), cuts_.end(), x) - cuts_.begin();
  }

  int axis_ = 0;
  std::vector<double> cuts_;  // rising
};

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

std::vector<std::pair<int, int>> box_pairs(const std::vector<Eigen::AlignedBox3d>& boxes,
                                           const std::function<bool(int, int)>& is_wanted,
                                           const std::vector<char>& is_active) {
  const Slabs slabs(boxes);
  const auto acts = [&](int i) { return is_active.empty() || is_active[i] != 0; };
  const std::vector<std::vector<int>> members = slabs.members(boxes);
  std::vector<std::vector<std::pair<int, int>>> found(members.size());
  parallel_tasks(found.size(), [&](std::size_t slab) {
    Eigen::AlignedBox3d around;  // what is active here
    for (const int i : members[slab]) {
      if (acts(i)) around.extend(boxes[i]);
    }
    std::vector<Box> list;
    for (const int i : members[slab]) {
      if (!around.intersects(boxes[i])) continue;
      const Vec3& low = boxes[i].min();
      const Vec3& high = boxes[i].max();
      list.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), i);
    }
    std::vector<const Box*> order;
    order.reserve(list.size());
    for (const Box& box : list) order.push_back(&box);
    CGAL::box_self_intersection_d(
        order.begin(), order.end(),
        [&](const Box* a, const Box* b) {
          const auto [i, j] = std::minmax({a->info(), b->info()});
          const bool is_here = std::max(slabs.first(boxes[i]), slabs.first(boxes[j])) == slab;
          if (is_here && (acts(i) || acts(j)) && is_wanted(i, j)) found[slab].emplace_back(i, j);
        },
        cutoff);
  });
  std::vector<std::pair<int, int>> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace hexwall
