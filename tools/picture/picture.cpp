// Renders a VTP or VTU file to PNG, without a display of its own: run it under xvfb-run.
//
//   xvfb-run -a hexwall-picture wall.vtu -o wall.png --array layer --edges
//   xvfb-run -a hexwall-picture surface.vtp -o s.png --texture checkerboard --lines critical.vtp
//   xvfb-run -a hexwall-picture wall.vtu -o cut.png --edges --clip 0,0,0,1,0,0 --view -1,0,0

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "core/errors.h"
#include "exporters/output_file.h"
#include "reference.h"
#include "report.h"
#include "scene.h"

namespace hexwall {
namespace {

std::array<int, 2> picture_size(const std::string& text) {
  std::array<int, 2> size{};
  char separator = 0;
  std::istringstream in(text);
  in >> size[0] >> separator >> size[1];
  constexpr int most_pixels = 16384;
  const bool fits =
      std::all_of(size.begin(), size.end(), [](int n) { return n > 0 && n <= most_pixels; });
  if (!in || separator != 'x' || !fits) throw UsageError("--size must be WIDTHxHEIGHT in pixels");
  return size;
}

void write_png(const std::string& path, vtkRenderWindow* window) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::string content(bytes->Begin(), bytes->End());
  write_output_file(path, content);
}

void render(const PictureOptions& options) {
  // VTK would abort without a word about what to do.
  if (std::getenv("DISPLAY") == nullptr)
    throw UsageError("no display: run hexwall-picture under xvfb-run -a");
  const auto size = picture_size(options.size);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(size[0], size[1]);
  build_scene(options, window);
  window->Render();
  write_png(options.output, window);
}

void add_reference_flag(CLI::App& app, const std::string& flag,
                        const std::function<std::string(const CommandInfo&)>& page) {
  app.add_flag_callback(flag,
                        [&app, page] {
                          fmt::print("{}", page(command_info(app.get_name(), app)));
                          throw CLI::Success();
                        })
      ->group("");
}

void declare_options(CLI::App& app, PictureOptions& o) {
  app.add_option("INPUT", o.input, "VTP or VTU file")->required();
  app.add_option("-o,--output", o.output, "PNG file to write")->required();
  app.add_option("--array", o.array, "point or cell array that gives the colours");
  app.add_option("--range", o.range, "values LOW,HIGH of the first and the last colour")
      ->delimiter(',')
      ->expected(2);
  app.add_flag("--edges", o.edges, "draw the edges of the cells");
  app.add_option("--texture", o.texture, "tiles of one unit of the texture coordinates")
      ->check(CLI::IsMember({"checkerboard"}));
  app.add_option("--view", o.view, "direction x,y,z from the data to the eye")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--frame", o.frame, "directions to the right and up: x,y,z,x,y,z, before --view")
      ->delimiter(',')
      ->expected(6);
  app.add_option("--focus", o.focus, "x,y,z,radius of what fills the picture [everything]")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--title", o.title, "title of the colours [the array's name]");
  app.add_option("--clip", o.clip, "show only cells beyond x,y,z in the direction nx,ny,nz")
      ->delimiter(',')
      ->expected(6);
  app.add_option("--zoom", o.zoom, "magnification, 1: all is seen")->check(CLI::PositiveNumber);
  app.add_option("--size", o.size, "size in pixels")->capture_default_str();
  app.add_option("--lines", o.lines, "VTP file whose polylines are drawn on top");
  app.add_flag("--perspective", o.perspective, "perspective instead of parallel projection");
  app.set_version_flag("--version", "hexwall-picture " + version());
  // For what is made from the program itself, as `hexwall reference` is.
  add_reference_flag(app, "--reference-man",
                     [](const CommandInfo& command) { return man_page(command, {"hexwall"}); });
  add_reference_flag(app, "--reference-bash",
                     [](const CommandInfo& command) { return bash_completion(command, {}); });
}

}  // namespace
}  // namespace hexwall

int main(int argc, char** argv) {
  hexwall::PictureOptions options;
  CLI::App app("Renders a VTP or VTU file to PNG; run it under xvfb-run -a", "hexwall-picture");
  hexwall::declare_options(app, options);
  try {
    app.parse(argc, argv);
    hexwall::render(options);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : static_cast<int>(hexwall::ExitCode::usage);
  } catch (const hexwall::Error& e) {
    fmt::print(stderr, "hexwall-picture: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    fmt::print(stderr, "hexwall-picture: internal error: {}\n", e.what());
    return static_cast<int>(hexwall::ExitCode::internal);
  }
}
