#include "exporters/corner_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

namespace hexwall {
namespace {

// Of the greatest value of an array: what corners differ by less is rounding.
constexpr double equal_values = 1e-9;

/// An array of values at corners.
class CornerArray {
 public:
  explicit CornerArray(const DataArray& data)
      : name_(data.name),
        components_(data.components),
        values_(std::get<std::vector<double>>(data.values)) {
    double greatest = 0.0;
    for (const double value : values_) greatest = std::max(greatest, std::abs(value));
    tolerance_ = equal_values * greatest;
  }

  bool are_equal(int a, int b) const {
    return std::equal(at(a), at(a) + components_, at(b),
                      [this](double x, double y) { return std::abs(x - y) <= tolerance_; });
  }

  DataArray of(const std::vector<int>& corners) const {
    std::vector<double> values;
    values.reserve(corners.size() * static_cast<std::size_t>(components_));
    for (const int corner : corners)
      values.insert(values.end(), at(corner), at(corner) + components_);
    return {name_, components_, std::move(values)};
  }

 private:
  std::vector<double>::const_iterator at(int corner) const {
    return values_.begin() + static_cast<std::ptrdiff_t>(corner) * components_;
  }

  std::string name_;
  int components_;
  const std::vector<double>& values_;
  double tolerance_;
};

}  // namespace

PolyData with_corner_values(const TriangleSurface& surface,
                            const std::vector<DataArray>& of_corners) {
  const std::vector<CornerArray> arrays(of_corners.begin(), of_corners.end());
  PolyData data;
  data.polygons.reserve(surface.triangles.size(), 3);
  // The points of a vertex are few: each knows the one before it.
  std::vector<int> last(surface.points.size(), -1);
  std::vector<int> before;
  std::vector<int> corner_of;
  const auto find_point = [&](int vertex, int corner) {
    const auto has_values = [&](int point) {
      return std::all_of(arrays.begin(), arrays.end(), [&](const CornerArray& array) {
        return array.are_equal(corner_of[point], corner);
      });
    };
    for (int point = last[vertex]; point >= 0; point = before[point]) {
      if (has_values(point)) return point;
    }
    data.points.push_back(surface.points[vertex]);
    corner_of.push_back(corner);
    before.push_back(std::exchange(last[vertex], static_cast<int>(before.size())));
    return last[vertex];
  };
  int corner = 0;
  for (const auto& triangle : surface.triangles) {
    std::array<int, 3> points;
    for (int k = 0; k < 3; ++k) points[k] = find_point(triangle[k], corner++);
    data.polygons.add(points);
  }
  for (const CornerArray& array : arrays) data.point_arrays.push_back(array.of(corner_of));
  return data;
}

}  // namespace hexwall
