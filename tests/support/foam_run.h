#pragma once

#include <filesystem>
#include <string>

namespace hexwall::test {

/// Whether a program is in PATH.
bool is_installed(const std::string& program);

/// Runs the `Allrun` of a case. \returns an empty text, or what went wrong.
std::string run_case(const std::filesystem::path& case_dir);

/// The last value of a function object that `hexwall case` sets up, such as `flowRate_inlet`; NaN
/// if it has none.
double last_value(const std::filesystem::path& case_dir, const std::string& function);

}  // namespace hexwall::test
