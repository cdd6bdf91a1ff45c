#pragma once

#include <charconv>
#include <cstddef>
#include <iterator>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>

namespace hexwall {

/// Text grown in place, or put into a stream piece by piece; numbers are the shortest that read
/// back to the same value.
class Text {
 public:
  explicit Text(std::size_t expected_size) { text_.reserve(expected_size); }
  /// What it passes on is lost to `take`. `pass_on` must be called at the end.
  explicit Text(std::ostream& stream) : stream_(&stream) { text_.reserve(2 * piece); }

  Text& operator<<(std::string_view s) {
    text_.append(s);
    if (stream_ != nullptr && text_.size() >= piece) pass_on();
    return *this;
  }
  Text& operator<<(char c) { return *this << std::string_view(&c, 1); }
  Text& operator<<(int value) { return number(value); }
  Text& operator<<(double value) { return number(value); }
  std::string take() { return std::move(text_); }
  void pass_on() {
    *stream_ << text_;
    text_.clear();
  }

 private:
  static constexpr std::size_t piece = std::size_t{1} << 20;

  template <typename T>
  Text& number(T value) {
    char digits[32];
    const char* end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }

  std::string text_;
  std::ostream* stream_ = nullptr;
};

}  // namespace hexwall
