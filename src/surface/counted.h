#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hexwall {

/// A number with its words, for messages: "1 edge has" or "3 edges have".
inline std::string counted(std::size_t count, std::string_view singular, std::string_view plural) {
  return std::to_string(count).append(" ").append(count == 1 ? singular : plural);
}

/// "1 edge" or "3 edges".
inline std::string counted(std::size_t count, const std::string& noun) {
  return counted(count, noun, noun + "s");
}

}  // namespace hexwall
