#pragma once

#include <charconv>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace hexwall {

/// Text grown in place; numbers are the shortest that read back to the same value.
class Text {
 public:
  explicit Text(std::size_t expected_size) { text_.reserve(expected_size); }
  Text& operator<<(std::string_view s) {
    text_.append(s);
    return *this;
  }
  Text& operator<<(char c) {
    text_.push_back(c);
    return *this;
  }
  Text& operator<<(int value) { return number(value); }
  Text& operator<<(double value) { return number(value); }
  std::string take() { return std::move(text_); }

 private:
  template <typename T>
  Text& number(T value) {
    char digits[32];
    const char* end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
    text_.append(digits, static_cast<std::size_t>(end - digits));
    return *this;
  }
  std::string text_;
};

}  // namespace hexwall
