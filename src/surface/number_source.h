#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hexwall {

/// Types of numbers in files.
enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64, int64, uint64 };

enum class Encoding { text, little_endian, big_endian };

/// The rest of a file of text and numbers, from which lines, words and numbers are taken. It never
/// believes a count: what is not there cannot be taken. `content` has to outlive it.
class NumberSource {
 public:
  explicit NumberSource(std::string_view content) : rest_(content) {}

  bool is_empty() const { return rest_.empty(); }

  /// The rest of the line, without its end. \throws ReadError at the end of the file.
  std::string_view line();

  /// The next word, empty at the end of the file; what ends it stays.
  std::string_view word();

  /// The next number. Of a text, any number will do, whatever the type.
  /// \throws ReadError if it is none, or the file ends before.
  double number(Scalar type, Encoding encoding);

  /// \throws ReadError if there are fewer bytes.
  std::string_view bytes(std::size_t count);

 private:
  template <typename Value>
  double take(Encoding encoding);
  double take_word();

  std::string_view rest_;
};

/// A whole number that is a count. \throws ReadError if it is none.
std::size_t count_of(std::string_view word);

/// As the index of a point: what lies beyond int, or is no whole number, becomes -1, which is
/// refused as out of range.
int index_of(double value);

}  // namespace hexwall
