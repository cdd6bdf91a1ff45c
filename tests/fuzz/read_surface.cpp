// Fuzz target of a reader of surfaces: the input is a file of the format HEXWALL_FUZZ_EXTENSION.

#include <algorithm>
#include <cmath>
#include <string_view>

#include "fuzz/fuzz_target.h"
#include "fuzz/memory_file.h"
#include "surface/check.h"
#include "surface/read.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

void require_arrays(const std::vector<SurfaceArray>& arrays, std::size_t tuples) {
  for (const SurfaceArray& array : arrays) {
    require(array.components >= 1, "the array '" + array.name + "' has no components");
    require(array.values.size() == tuples * array.components,
            "the array '" + array.name + "' has a wrong length");
  }
}

void require_consistent(const ReadResult& read) {
  const std::size_t count = read.surface.points.size();
  require(!read.surface.triangles.empty(), "a surface without triangles");
  std::vector<char> is_used(count, 0);
  for (const auto& triangle : read.surface.triangles) {
    for (const int v : triangle) {
      require(v >= 0 && static_cast<std::size_t>(v) < count, "an index is out of range");
      is_used[v] = 1;
    }
  }
  require(std::count(is_used.begin(), is_used.end(), 0) == 0, "a point without triangles");
  require_arrays(read.point_arrays, count);
  require_arrays(read.cell_arrays, read.surface.triangles.size());
}

/// PLY keeps all that a surface is: written and read again, it must be the same.
void require_round_trip(const TriangleSurface& surface) {
  const MemoryFile file("-copy.ply");
  write_surface(file.path(), surface);
  const TriangleSurface copy = read_surface(file.path()).surface;
  require(copy.triangles == surface.triangles, "the triangles differ when written and read again");
  const auto is_same = [](const Vec3& a, const Vec3& b) {
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
      return x == y || (std::isnan(x) && std::isnan(y));
    });
  };
  require(std::equal(copy.points.begin(), copy.points.end(), surface.points.begin(),
                     surface.points.end(), is_same),
          "the points differ when written and read again");
}

}  // namespace
}  // namespace hexwall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  const test::MemoryFile file(HEXWALL_FUZZ_EXTENSION, {reinterpret_cast<const char*>(data), size});
  ReadResult read;
  if (!test::succeeds([&] { read = read_surface(file.path()); })) return 0;
  test::require_consistent(read);
  test::require_round_trip(read.surface);
  test::succeeds([&] { find_problems(read.surface); });
  return 0;
}
