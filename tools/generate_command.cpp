#include "generate_command.h"

#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "surface/generate.h"
#include "surface/write.h"

namespace hexwall {
namespace {

struct GenerateOptions {
  std::string shape;
  std::string output;
  std::optional<double> edge;
};

ExitCode run_generate(const GenerateOptions& c) {
  const TriangleSurface surface = generate_shape(shape_from_name(c.shape), c.edge);
  write_surface(c.output, surface);
  fmt::print("{}: {} vertices, {} triangles\n", c.output, surface.points.size(),
             surface.triangles.size());
  return ExitCode::success;
}

}  // namespace

Command add_generate(CLI::App& app) {
  CLI::App* generate = app.add_subcommand("generate", "Make a surface to try hexwall on");
  const auto c = std::make_shared<GenerateOptions>();
  generate
      ->add_option("SHAPE", c->shape, "annulus, eccentric-annulus, cylinder, bifurcation or aaa")
      ->required();
  generate->add_option("-o,--output", c->output, "File: .stl, .obj, .ply, .off, .vtp or .vtk")
      ->required();
  generate->add_option("--edge", c->edge, "Edge length of the triangles [by shape]");
  return {generate, [c] { return run_generate(*c); }};
}

}  // namespace hexwall
