#pragma once

#include <string>
#include <vector>

namespace hexwall {

/// Data on a surface: one tuple per point or per triangle.
struct SurfaceArray {
  std::string name;
  int components = 1;
  std::vector<double> values;  ///< tuple after tuple: #tuples x components

  int tuples() const { return static_cast<int>(values.size()) / components; }
};

/// The array after a change of its surface: tuple `i` is the former tuple `origin[i]`, or not a
/// number where `origin[i]` is negative (something new).
SurfaceArray follow(const SurfaceArray& array, const std::vector<int>& origin);

/// The same for each of several arrays.
std::vector<SurfaceArray> follow(const std::vector<SurfaceArray>& arrays,
                                 const std::vector<int>& origin);

}  // namespace hexwall
