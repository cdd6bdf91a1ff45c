// Fuzz target of the reader of planes that cut off ends.

#include <cmath>

#include "fuzz/fuzz_target.h"
#include "fuzz/memory_file.h"
#include "surface/cut_planes.h"
#include "surface/names.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  const test::MemoryFile file(".txt", {reinterpret_cast<const char*>(data), size});
  std::vector<CutPlane> planes;
  if (!test::succeeds([&] { planes = read_cut_planes(file.path()); })) return 0;
  test::require(!planes.empty(), "no planes, and no complaint");
  for (const CutPlane& plane : planes) {
    test::require(plane.point.allFinite(), "a point is not finite");
    test::require(std::abs(plane.normal.norm() - 1.0) < 1e-12, "a normal is not a unit vector");
    test::require(plane.radius.value_or(1.0) > 0.0, "a radius is not positive");
    test::require(plane.name.empty() || is_valid_name(plane.name), "a name is not valid");
  }
  return 0;
}
