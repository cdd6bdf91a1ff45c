#include "view_command.h"

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "child_process.h"
#include "core/errors.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

// The report of a folder of results, or the file itself.
fs::path report_of(const std::string& folder) {
  const fs::path given = folder;
  const fs::path report = fs::is_directory(given) ? given / "report.html" : given;
  if (!fs::exists(report)) {
    throw ReadError(fmt::format(
        "there is no {}: give the folder that 'hexwall mesh -o' wrote, without --no-report",
        report.string()));
  }
  return fs::absolute(report).lexically_normal();
}

bool has_display() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

ExitCode run_view(const std::string& folder) {
  const fs::path report = report_of(folder);
  if (has_display() && start_program({"xdg-open", report.string()}, 2)) {
    fmt::print("{} is open in the browser\n", report.string());
    return ExitCode::success;
  }
  fmt::print("{}\n", report.string());
  fmt::print(stderr, "No browser could be started here: open the file above in one.\n");
  return ExitCode::success;
}

}  // namespace

Command add_view(CLI::App& app) {
  CLI::App* view = app.add_subcommand("view", "Open the report of a run in the browser");
  const auto folder = std::make_shared<std::string>();
  view->add_option("DIR", *folder, "Folder that 'hexwall mesh' wrote")->required();
  return {view, [folder] { return run_view(*folder); }};
}

}  // namespace hexwall
