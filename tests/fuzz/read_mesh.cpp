// Fuzz target of a reader of meshes, HEXWALL_FUZZ_PARSE: what it takes must be measurable.

#include "inspect/read_mesh.h"

#include <string>

#include <nlohmann/json.hpp>

#include "fuzz/fuzz_target.h"
#include "inspect/mesh_quality.h"

namespace hexwall::test {
namespace {

// The files of an OpenFOAM mesh one behind the other, each ended by a form feed.
[[maybe_unused]] AnyMesh parse_foam_files(const std::string& content) {
  FoamFiles files;
  std::size_t at = 0;
  for (std::string* file : {&files.points, &files.faces, &files.owner, &files.neighbour}) {
    const std::size_t end = content.find('\f', at);
    *file = content.substr(at, end - at);
    at = end == std::string::npos ? content.size() : end + 1;
  }
  return parse_foam(files);
}

void require_measurable(const AnyMesh& mesh) {
  const MeshQuality quality = mesh_quality(mesh);
  std::size_t elements = 0;
  for (const std::size_t count : quality.count) elements += count;
  require(elements == mesh.shape.size(), "an element is not counted");
  for (const MetricResult& result : quality.metrics) {
    std::size_t in_bins = 0;
    for (const std::size_t count : result.all.histogram.counts) in_bins += count;
    require(in_bins == result.all.count, "a value is in no bin");
  }
  to_json(quality).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace
}  // namespace hexwall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwall;
  using namespace hexwall::test;
  const std::string content(reinterpret_cast<const char*>(data), size);
  AnyMesh mesh;
  if (!succeeds([&] {
        mesh = HEXWALL_FUZZ_PARSE(content);
        check_mesh_is_sound(mesh);
        orient_wedges(mesh);
      })) {
    return 0;
  }
  require_measurable(mesh);
  return 0;
}
