#pragma once
#include <initializer_list>

#include "core/synthetic/hash_random.h"

namespace scantrove::synthetic {

/// A reproducible sequence of random numbers, the same on every computer. Draw into variables or braces,
/// never within the arguments of one call, whose order the compiler chooses.
class HashStream {
 public:
  explicit HashStream(std::uint32_t seed, std::uint32_t purpose = 0) : seed_(seed), purpose_(purpose) {}

  [[nodiscard]] std::uint32_t bits() { return hashBits(drawn_++, purpose_, 41, seed_); }
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * hashUniform(bits()); }
  /// 0 ... count - 1.
  [[nodiscard]] int below(int count) {
    return static_cast<int>(hashUniform(bits()) * static_cast<float>(count));
  }
  [[nodiscard]] int between(int low, int high) { return low + below(high - low + 1); }
  [[nodiscard]] bool chance(double probability) { return hashUniform(bits()) < probability; }
  [[nodiscard]] double sign() { return chance(0.5) ? 1.0 : -1.0; }
  template <class T>
  [[nodiscard]] T pick(std::initializer_list<T> choices) {
    return choices.begin()[below(static_cast<int>(choices.size()))];
  }

 private:
  std::uint32_t seed_;
  std::uint32_t purpose_;
  std::uint32_t drawn_ = 0;
};

}  // namespace scantrove::synthetic
