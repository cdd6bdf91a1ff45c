#include "pictures.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "child_process.h"
#include "exporters/picture_scenes.h"

namespace hexwall {
namespace {

namespace fs = std::filesystem;

constexpr int seconds_for_xvfb = 20;

/// A display for the renderer: of an X server that is started for it, or the one there is.
class Display {
 public:
  Display()
      : server_(std::make_unique<Companion>(std::vector<std::string>{
            "Xvfb", "-displayfd", "3", "-screen", "0", "1280x1024x24", "-nolisten", "tcp"})) {
    const std::string number = server_->is_running() ? server_->first_line(seconds_for_xvfb) : "";
    if (!number.empty()) {
      name_ = ":" + number;
      return;
    }
    server_.reset();
    if (const char* there = std::getenv("DISPLAY"); there != nullptr) name_ = there;
  }

  /// Empty: there is none.
  const std::string& name() const { return name_; }

 private:
  std::unique_ptr<Companion> server_;
  std::string name_;
};

// Beside this program, or in PATH.
std::string renderer() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path beside = here / "hexwall-picture";
  return !error && fs::exists(beside) ? beside.string() : "hexwall-picture";
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  const std::size_t start = text.rfind('\n');
  return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

PictureResult take_pictures(const fs::path& folder, const PipelineResult& result,
                            const std::function<void(int, int)>& progress) {
  const Display display;
  if (display.name().empty()) {
    return {{}, "There are no pictures: they need a display, or Xvfb (Debian package xvfb)."};
  }
  fs::create_directories(folder);
  const std::vector<PictureScene> scenes = write_picture_scenes(folder, result);
  PictureResult taken;
  for (const PictureScene& scene : scenes) {
    progress(static_cast<int>(taken.pictures.size()), static_cast<int>(scenes.size()));
    const fs::path png = folder / (scene.name + ".png");
    std::vector<std::string> command{renderer()};
    command.insert(command.end(), scene.arguments.begin(), scene.arguments.end());
    command.insert(command.end(), {"-o", png.string(), "--size", "1400x1050"});
    const ChildOutcome outcome = run_program(command, {"DISPLAY=" + display.name()});
    if (outcome.exit_code != 0) {
      const std::string why = outcome.output.empty()
                                  ? std::string("the program hexwall-picture can't be run")
                                  : last_line(outcome.output);
      return {{}, fmt::format("There are no pictures: {}.", why)};
    }
    taken.pictures.push_back({scene.name, scene.caption, bytes_of(png)});
  }
  return taken;
}

}  // namespace hexwall
