#include "surface/line_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {

LineReader::LineReader(std::string_view text, LineSyntax syntax)
    : rest_(text), comment_(syntax.comment) {
  for (const unsigned char c : syntax.blanks) is_blank_[c] = true;
}

bool LineReader::next(Tokens& tokens) {
  do {
    if (rest_.empty()) return false;
    const std::size_t feed = std::min(rest_.find('\n'), rest_.size());
    const std::size_t end = std::min(rest_.substr(0, feed).find('\r'), feed);
    const bool is_crlf = rest_.substr(end).starts_with("\r\n");
    line_text_ = rest_.substr(0, end);
    const std::size_t comment =
        comment_.empty() ? std::string_view::npos : line_text_.find(comment_);
    split(line_text_.substr(0, comment), tokens);
    rest_.remove_prefix(std::min(end + (is_crlf ? 2 : 1), rest_.size()));
    ++line_;
  } while (tokens.empty());
  return true;
}

void LineReader::fail(const std::string& message) const {
  throw ReadError(fmt::format("line {}: {}", line_, message));
}

template <typename Number>
Number LineReader::parse(std::string_view word) const {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  Number value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    fail(fmt::format("'{}' is not a number of the expected kind", word));
  }
  return value;
}

template double LineReader::parse(std::string_view) const;
template int LineReader::parse(std::string_view) const;
template std::uint32_t LineReader::parse(std::string_view) const;
template std::int64_t LineReader::parse(std::string_view) const;

void LineReader::split(std::string_view line, Tokens& tokens) const {
  const auto is_blank = [this](unsigned char c) { return is_blank_[c]; };
  tokens.clear();
  for (auto at = line.begin(); at != line.end();) {
    const auto first = std::find_if_not(at, line.end(), is_blank);
    at = std::find_if(first, line.end(), is_blank);
    if (first != at) tokens.emplace_back(first, at);
  }
}

}  // namespace hexwall
