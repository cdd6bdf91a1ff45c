// Fuzz target of everything between reading and writing: the input says how a small vessel is
// damaged and what is asked for. Either it is refused, or a mesh comes out that the independent
// verifier finds no fault with. With HEXWALL_FUZZ_SURFACE=file.ply in the environment, the surface
// is written there first.

#include "pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "fuzz/byte_source.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/mutated_surface.h"
#include "support/distance.h"
#include "support/mesh_verifier.h"
#include "support/verify_wall.h"
#include "surface/write.h"

namespace hexwall::test {
namespace {

struct Request {
  double quads = 0.0;
  PrepareOptions prepare;
  PipelineOptions pipeline;
};

Request request_of(ByteSource& bytes) {
  Request request;
  const unsigned choices = bytes.byte();
  request.quads = (choices & 1U) != 0 ? 300.0 : 60.0;
  request.pipeline.size_by_radius = (choices & 2U) != 0;
  request.pipeline.outward->layers = (choices & 4U) != 0 ? 3 : 1;
  request.pipeline.outward->growth = (choices & 8U) != 0 ? 1.5 : 1.0;
  request.prepare.extend = (choices & 16U) != 0 ? 1.0 : 0.0;
  request.pipeline.relax = (choices & 32U) != 0 ? 1.0 : 0.5;
  const bool is_thick = (choices & 64U) != 0;
  if (is_thick) request.pipeline.outward->thickness = 1.0;
  if ((choices & 128U) != 0) {
    request.pipeline.poles.mode = PoleRequest::Mode::count;
    request.pipeline.poles.count = bytes.byte() % 4;
  }
  request.pipeline.stretch = std::array{1.0, 2.0, 0.5, 4.0}[bytes.byte() % 4];
  return request;
}

void write_on_demand(const TriangleSurface& surface) {
  if (const char* path = std::getenv("HEXWALL_FUZZ_SURFACE")) write_surface(path, surface);
}

void require_valid_quads(const PipelineResult& r) {
  const QuadVerdict verdict = verify_quads(static_cast<int>(r.quads.points.size()), r.quads.quads);
  require(verdict.faults.none(), "quads: " + verdict.faults.text());
  const int loops = static_cast<int>(r.openings.size());
  require(verdict.components == 1, "the quads fall apart");
  require(verdict.boundary_loops == loops,
          "the quads have " + std::to_string(verdict.boundary_loops) +
              " openings, the surface has " + std::to_string(loops));
  require(verdict.euler_number == 2 - loops, "the quads have handles");
}

void require_on_surface(const PipelineResult& r) {
  double farthest = 0.0;
  for (const Vec3& p : r.surface.points) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  const double tolerance = 1e-6 * bounding_box_diagonal(r.surface) +
                           16.0 * std::numeric_limits<double>::epsilon() * farthest;
  const SurfaceDistance distance(r.surface);
  for (const Vec3& p : r.quads.points) {
    require(distance(p).distance <= tolerance, "a quad's vertex is off the surface");
  }
}

void require_valid_wall(const PipelineResult& r) {
  expect_valid_wall(r);  // in GoogleTest's words, which need no running test
  require(!testing::Test::HasFailure(), "the wall is not valid");
}

}  // namespace
}  // namespace hexwall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  test::ByteSource bytes(data, size);
  test::Request request = test::request_of(bytes);
  ReadResult read;
  read.surface = test::mutated_surface(bytes);
  if (read.surface.triangles.empty()) return 0;
  test::write_on_demand(read.surface);
  PipelineResult result;
  const bool is_meshed = test::succeeds([&] {
    const PrepareResult prepared = prepare_surface(read, request.prepare);
    request.pipeline.size = std::sqrt(total_area(prepared.surface) / request.quads);
    result = run_pipeline(prepared, request.pipeline);
  });
  if (!is_meshed) return 0;
  test::require_valid_quads(result);
  test::require_on_surface(result);
  test::require_valid_wall(result);
  return 0;
}
