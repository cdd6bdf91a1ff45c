// The program. Sample runs:
//
//   hexwall mesh aneurysm.stl -o out --size 0.8 --thickness 0.5 --layers 3
//   hexwall case aneurysm.stl -o run --re 300 && run/Allrun && hexwall shear run
//   hexwall check carotid.vtp
//   hexwall generate aaa -o aaa.stl
//
// `mesh` reads a vessel surface, runs the pipeline and writes the quad mesh, the hexahedral wall,
// an OpenFOAM case and a report. `check` says what is wrong with a surface. `generate` makes
// surfaces to try it on.

#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "case_command.h"
#include "check_command.h"
#include "compare_command.h"
#include "generate_command.h"
#include "interrupt.h"
#include "lumen_command.h"
#include "mesh_command.h"
#include "quality_command.h"
#include "reference_command.h"
#include "report.h"
#include "shear_command.h"
#include "view_command.h"

namespace hexwall {
namespace {

int fail(ExitCode code, const std::string& message) {
  wait_if_interrupted();
  fmt::print(stderr, "hexwall: error: {}\n", message);
  return static_cast<int>(code);
}

int run_command(const Command& command) {
  try {
    return static_cast<int>(command.run());
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::internal, "out of memory: choose a larger --size");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal,
                fmt::format("{}. This is a bug in hexwall: please report it", error.what()));
  }
}

int run(int argc, char** argv) {
  CLI::App app{"hexwall: hexahedral wall meshes of blood vessels"};
  app.set_version_flag("--version", "hexwall " + version());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 success, 1 internal error, 2 command line, 3 unreadable input,\n"
      "4 topology of the surface, 5 geometry of the surface, 6 no valid mesh, 7 output,\n"
      "8 a condition of 'quality --fail-if' holds, 130 stopped by Ctrl-C.");
  const std::vector<Command> commands{
      add_mesh(app),  add_lumen(app),   add_compare(app), add_case(app),     add_shear(app),
      add_check(app), add_quality(app), add_view(app),    add_generate(app), add_reference(app),
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) return run_command(command);
  }
  return static_cast<int>(ExitCode::usage);
}

}  // namespace
}  // namespace hexwall

int main(int argc, char** argv) {
  hexwall::handle_interrupts();
  return hexwall::run(argc, argv);
}
