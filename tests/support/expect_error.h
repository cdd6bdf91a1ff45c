#pragma once

#include <initializer_list>
#include <string>

#include <gtest/gtest.h>

#include "core/errors.h"

namespace hexwall::test {

/// Expects `action` to throw a hexwall::Error of the class `code` whose message has all of `words`.
template <typename Action>
void expect_error(ExitCode code, std::initializer_list<const char*> words, Action&& action) {
  try {
    action();
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

}  // namespace hexwall::test
