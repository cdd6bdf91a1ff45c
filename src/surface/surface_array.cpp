#include "surface/surface_array.h"

#include <limits>

namespace hexwall {

SurfaceArray follow(const SurfaceArray& array, const std::vector<int>& origin) {
  SurfaceArray result{array.name, array.components, {}};
  result.values.reserve(origin.size() * array.components);
  for (const int tuple : origin) {
    for (int k = 0; k < array.components; ++k) {
      result.values.push_back(tuple < 0 ? std::numeric_limits<double>::quiet_NaN()
                                        : array.values[tuple * array.components + k]);
    }
  }
  return result;
}

std::vector<SurfaceArray> follow(const std::vector<SurfaceArray>& arrays,
                                 const std::vector<int>& origin) {
  std::vector<SurfaceArray> result;
  result.reserve(arrays.size());
  for (const SurfaceArray& array : arrays) result.push_back(follow(array, origin));
  return result;
}

}  // namespace hexwall
