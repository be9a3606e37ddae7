#pragma once
#include <cstdint>

namespace scantrove::synthetic {

/// A well mixed 32-bit hash of up to three integers and a seed. As stateless random numbers they make pixels
/// independent of the order in which they are rendered.
[[nodiscard]] constexpr std::uint32_t hashBits(std::uint32_t x, std::uint32_t y = 0, std::uint32_t z = 0,
                                               std::uint32_t seed = 0) {
  std::uint32_t h = x * 0x8da6b343U ^ y * 0xd8163841U ^ z * 0xcb1ab31fU ^ (seed + 0x9e3779b9U) * 0x85ebca6bU;
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  h ^= h >> 16;
  return h;
}

/// floor() of a number that fits an int; the library's is a function call without SSE 4.1.
[[nodiscard]] constexpr int floorInt(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

/// Uniform in [0, 1).
[[nodiscard]] constexpr float hashUniform(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24F;
}

}  // namespace scantrove::synthetic
