#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace hexwall {

/// How a text format separates words and marks comments.
struct LineSyntax {
  std::string_view blanks = " \t\v\f";
  std::string_view comment = "#";  ///< up to the end of the line; empty: there are none
};

/// Walks through a text line by line, each split into words.
class LineReader {
 public:
  using Tokens = std::vector<std::string_view>;

  explicit LineReader(std::string_view text, LineSyntax syntax = {});

  /// The next line with something on it but a comment; false at the end of the text.
  bool next(Tokens& tokens);

  /// The line that `next` took, as it stands in the text.
  std::string_view text() const { return line_text_; }

  /// \throws ReadError with the number of the line.
  [[noreturn]] void fail(const std::string& message) const;

  /// \throws ReadError, with the number of the line, if the word is no such number.
  template <typename Number>
  Number parse(std::string_view word) const;

 private:
  void split(std::string_view line, Tokens& tokens) const;

  std::string_view rest_;
  std::string_view comment_;
  std::array<bool, 256> is_blank_{};
  std::string_view line_text_;
  int line_ = 0;
};

}  // namespace hexwall
