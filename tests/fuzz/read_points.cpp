// Fuzz target of the reader of points.

#include "surface/read_points.h"

#include "fuzz/fuzz_target.h"
#include "fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  const test::MemoryFile file(".txt", {reinterpret_cast<const char*>(data), size});
  std::vector<Vec3> points;
  if (!test::succeeds([&] { points = read_points(file.path()); })) return 0;
  test::require(!points.empty(), "no points, and no complaint");
  for (const Vec3& p : points) test::require(p.allFinite(), "a point is not finite");
  return 0;
}
