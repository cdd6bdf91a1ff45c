#include "surface/number_source.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "core/errors.h"

namespace hexwall {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

}  // namespace

std::string_view NumberSource::line() {
  if (rest_.empty()) throw ReadError("the file is truncated");
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return line;
}

std::string_view NumberSource::word() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
  const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
  rest_.remove_prefix(word.size());
  return word;
}

std::string_view NumberSource::bytes(std::size_t count) {
  if (rest_.size() < count) throw ReadError("the file is truncated");
  const std::string_view bytes = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return bytes;
}

double NumberSource::number(Scalar type, Encoding encoding) {
  if (encoding == Encoding::text) return take_word();
  switch (type) {
    case Scalar::int8:
      return take<std::int8_t>(encoding);
    case Scalar::uint8:
      return take<std::uint8_t>(encoding);
    case Scalar::int16:
      return take<std::int16_t>(encoding);
    case Scalar::uint16:
      return take<std::uint16_t>(encoding);
    case Scalar::int32:
      return take<std::int32_t>(encoding);
    case Scalar::uint32:
      return take<std::uint32_t>(encoding);
    case Scalar::int64:
      return take<std::int64_t>(encoding);
    case Scalar::uint64:
      return take<std::uint64_t>(encoding);
    case Scalar::float32:
      return take<float>(encoding);
    case Scalar::float64:
      return take<double>(encoding);
  }
  return 0.0;
}

template <typename Value>
double NumberSource::take(Encoding encoding) {
  std::array<char, sizeof(Value)> value;
  const std::string_view taken = bytes(value.size());
  std::copy(taken.begin(), taken.end(), value.begin());
  const bool is_native =
      (encoding == Encoding::little_endian) == (std::endian::native == std::endian::little);
  if (!is_native) std::reverse(value.begin(), value.end());
  return static_cast<double>(std::bit_cast<Value>(value));
}

double NumberSource::take_word() {
  const std::string_view taken = word();
  if (taken.empty()) throw ReadError("the file is truncated");
  const std::string_view digits = taken.starts_with('+') ? taken.substr(1) : taken;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    throw ReadError(fmt::format("'{}' is not a number", taken));
  }
  return value;
}

std::size_t count_of(std::string_view word) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error == std::errc{} && end == word.data() + word.size()) return count;
  throw ReadError(word.empty() ? "the file is truncated" : fmt::format("'{}' is no count", word));
}

int index_of(double value) {
  const bool is_index = value >= 0.0 && value < 2147483647.0;
  const int index = is_index ? static_cast<int>(value) : -1;
  return index == value ? index : -1;
}

}  // namespace hexwall
