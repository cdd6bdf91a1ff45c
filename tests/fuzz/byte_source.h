#pragma once

#include <cstddef>
#include <cstdint>

namespace hexwall::test {

/// The input of a fuzz target, taken in pieces from its front; at its end it yields zeros.
class ByteSource {
 public:
  ByteSource(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return size_ == 0; }

  std::uint8_t byte() {
    if (empty()) return 0;
    --size_;
    return *data_++;
  }

  /// From 0 to count - 1, from two bytes. \pre count > 0.
  int index(std::size_t count) {
    const std::size_t high = byte();
    return static_cast<int>((256 * high + byte()) % count);
  }

  /// From -1 to 127/128, from one byte.
  double fraction() { return static_cast<std::int8_t>(byte()) / 128.0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace hexwall::test
