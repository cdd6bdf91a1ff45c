// Meshes a generated bifurcation in memory: no file is read; one is written where asked for.

#include <exception>
#include <filesystem>
#include <hexwall/core/cancel.h>
#include <hexwall/core/errors.h>
#include <hexwall/exporters/gmsh.h>
#include <hexwall/pipeline.h>
#include <hexwall/report.h>
#include <hexwall/surface/generate.h>
#include <iostream>
#include <stop_token>
#include <string>

#include <nlohmann/json.hpp>

namespace {

void mesh(const std::filesystem::path& output) {
  const hexwall::ReadResult surface{
      hexwall::generate_shape(hexwall::Shape::bifurcation, 0.3), {}, {}, {}};
  const hexwall::PrepareResult prepared = hexwall::prepare_surface(surface);
  hexwall::PipelineOptions options;
  options.size = 0.4;
  options.outward->layers = 2;

  const hexwall::PipelineResult result =
      hexwall::run_pipeline(prepared, options, [](const std::string& stage, int index, int count) {
        std::cout << index + 1 << "/" << count << " " << stage << "\n";
      });
  const auto report = make_report(result, {"memory", "mm", 0, 0, &prepared, {}});
  std::cout << result.wall.cells() << " hexes, least scaled Jacobian "
            << report["wall"]["min_scaled_jacobian"] << "\n";
  hexwall::write_gmsh(output, result.wall);

  std::stop_source stop;
  stop.request_stop();
  const hexwall::CancelScope scope([&] { return stop.stop_requested(); });
  try {
    run_pipeline(prepared, options);
  } catch (const hexwall::Cancelled& cancelled) {
    std::cout << cancelled.what() << "\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    mesh(argv[1]);
  } catch (const hexwall::Error& error) {
    std::cerr << error.what() << "\n";
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
