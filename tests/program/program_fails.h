#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/child_process.h"
#include "support/temporary_folder.h"
#include "surface/generate.h"
#include "surface/write.h"

namespace hexwall::test {

/// Failures of the program: their exit code, their words, and that nothing is written.
class ProgramFails : public testing::Test {
 protected:
  ProgramFails() : surface_((folder_ / "tube.stl").string()), output_((folder_ / "out").string()) {
    write_surface(surface_, cylinder(1.0, 3.0, 16, 6));
  }

  /// The program ends with `code`, says all `words` on the error stream only, and leaves the
  /// folder as it was.
  void expect_failure(int code, const std::vector<std::string>& words,
                      const std::vector<std::string>& arguments) {
    const auto before = files();
    const ChildResult result = run_hexwall(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    for (const std::string& word : words) {
      EXPECT_NE(result.err.find(word), std::string::npos) << word << " in: " << result.err;
    }
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before);
  }

  void expect_usage_error(const std::vector<std::string>& words,
                          const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"mesh", surface_, "-o", output_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_failure(2, words, arguments);
  }

  /// Writes a file and expects it to be refused with its path and `words`.
  void expect_unreadable(const std::string& name, const std::string& bytes,
                         const std::string& words) {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    expect_failure(3, {"hexwall: error: ", name, words}, {"mesh", path, "-o", output_});
  }

  /// Expects a surface to be refused with `words`.
  void expect_refused(int code, const std::vector<std::string>& words,
                      const TriangleSurface& surface, const std::vector<std::string>& more = {}) {
    const std::string path = (folder_ / "bad.vtp").string();
    write_surface(path, surface);
    std::vector<std::string> all{"hexwall: error: "};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<std::string> arguments{"mesh", path, "-o", output_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_failure(code, all, arguments);
  }

  /// Writes a file for an option to read. \returns its path.
  std::string text_file(const std::string& name, const std::string& text) const {
    std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }

  /// All files and folders, with the bytes of the files.
  std::vector<std::pair<std::string, std::string>> files() const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      all.emplace_back(entry.path().string(),
                       entry.is_regular_file() ? bytes_of(entry.path()) : std::string());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  TemporaryFolder folder_;
  std::string surface_, output_;
};

}  // namespace hexwall::test
