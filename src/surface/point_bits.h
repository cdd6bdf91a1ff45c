#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "surface/triangle_surface.h"

namespace hexwall {

/// Coordinates as a key of hash maps, for points of exactly equal coordinates.
using PointBits = std::array<std::uint64_t, 3>;

struct PointBitsHash {
  std::size_t operator()(const PointBits& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t b : bits) {
      hash = (hash ^ b) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
  }
};

// Adding 0 turns -0 into +0, the one pair of equal numbers with different bits. Comparing bits
// instead of numbers lets a NaN equal itself, so that it reaches the check of the coordinates.
inline PointBits bits_of(const Vec3& p) {
  return {std::bit_cast<std::uint64_t>(p.x() + 0.0), std::bit_cast<std::uint64_t>(p.y() + 0.0),
          std::bit_cast<std::uint64_t>(p.z() + 0.0)};
}

}  // namespace hexwall
