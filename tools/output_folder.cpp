#include "output_folder.h"

#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace fs = std::filesystem;

namespace {

constexpr const char* staging_name = ".hexwall-partial";

[[noreturn]] void fail(const fs::path& path, const std::error_code& reason) {
  throw WriteError(fmt::format("cannot write to {}: {}", path.string(), reason.message()));
}

fs::path topmost_missing(const fs::path& folder) {
  fs::path missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p); p = p.parent_path()) missing = p;
  return missing;
}

// Others may still be writing into the folder: what they make meanwhile is removed as well.
void remove_while_in_use(const fs::path& folder) {
  constexpr int most_attempts = 100;
  for (int i = 0; i < most_attempts && fs::exists(folder); ++i) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder)
    : folder_(fs::absolute(folder).lexically_normal()), staging_(folder_ / staging_name) {
  std::error_code error;
  first_created_ = topmost_missing(folder_);
  fs::remove_all(staging_, error);
  fs::create_directories(staging_, error);
  if (error) {
    std::error_code ignored;
    if (!first_created_.empty()) fs::remove_all(first_created_, ignored);
    fail(folder_, error);
  }
  cleanup_.emplace([staging = staging_, created = first_created_] {
    remove_while_in_use(staging);
    if (!created.empty()) remove_while_in_use(created);
  });
}

OutputFolder::~OutputFolder() {
  cleanup_.reset();
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (!first_created_.empty()) fs::remove_all(first_created_, ignored);
}

void OutputFolder::commit() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(staging_)) {
    if (!entry.is_directory()) files.push_back(entry.path());
  }
  const auto uninterrupted = hold_interrupts();
  first_created_.clear();
  for (const fs::path& file : files) {
    const fs::path target = folder_ / fs::relative(file, staging_);
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (!error) fs::rename(file, target, error);
    if (error) fail(target, error);
  }
}

}  // namespace hexwall
