#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/errors.h"

/// The one function of a fuzz target: libFuzzer calls it, and so does replay.cpp. It returns 0 if
/// hexwall handles the input as it should, and ends the process if not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hexwall::test {

/// Ends the process with a message, unless `holds`.
inline void require(bool holds, const std::string& message) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", message.c_str());
  std::abort();
}

/// Whether `function` succeeds. It may fail with any Error that is not internal; everything else
/// that it throws ends the process, because nobody catches it. With HEXWALL_FUZZ_REASONS in the
/// environment it tells why it failed.
template <typename Function>
bool succeeds(const Function& function) {
  try {
    function();
    return true;
  } catch (const Error& error) {
    require(error.code() != ExitCode::internal, std::string("internal error: ") + error.what());
    require(*error.what() != '\0', "an error without a message");
    if (std::getenv("HEXWALL_FUZZ_REASONS") != nullptr) {
      std::fprintf(stderr, "refused: %s\n", error.what());
    }
    return false;
  }
}

}  // namespace hexwall::test
