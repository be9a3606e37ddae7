#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace scantrove::test {

/// Mutates inputs: bits, bytes, numbers (binary and text), removed, repeated and exchanged parts. The same
/// seed gives the same inputs on every system.
class Mutator {
 public:
  explicit Mutator(std::vector<std::string> seeds, std::uint64_t seed)
      : seeds_(std::move(seeds)), random_(seed) {}

  [[nodiscard]] std::string next() {
    std::string input = seeds_[below(seeds_.size())];
    for (std::size_t i = 1 + below(6); i > 0; --i) change(input);
    return input;
  }

 private:
  /// 0 ... limit - 1; 0 for limit 0. Distributions of the standard library differ between libraries.
  std::size_t below(std::size_t limit) {
    return limit == 0 ? 0 : static_cast<std::size_t>(random_() % limit);
  }

  void change(std::string& input) {
    static constexpr std::array<const char*, 10> kWords{
        "-1", "0", "1e999", "nan", "99999999999999999999", "inf", "2147483648", "1e-300", "\"", "#"};
    const std::size_t at = below(input.size());
    const std::size_t length = std::min(input.size() - at, 1 + below(below(4) == 0 ? 4096 : 16));
    switch (below(9)) {
      case 0:
        if (!input.empty()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 1:
        if (!input.empty()) input[at] = static_cast<char>(random_());
        break;
      case 2:
        writeNumber(input, at);
        break;
      case 3:
        input.erase(at, length);
        break;
      case 4:
        input.insert(at, input.substr(at, length));
        break;
      case 5:
        input.resize(at);
        break;
      case 6:
        input.replace(at, length, kWords[below(kWords.size())]);
        break;
      case 7: {
        const std::string& other = seeds_[below(seeds_.size())];
        input.replace(at, length, other.substr(below(other.size()), length));
        break;
      }
      default:
        for (std::size_t i = at; i < at + length; ++i) input[i] = static_cast<char>(random_());
    }
  }

  /// Writes an extreme number of 2, 4 or 8 bytes, in either byte order.
  void writeNumber(std::string& input, std::size_t at) {
    static constexpr std::array<std::uint64_t, 8> kNumbers{
        0, 1, 0x7FFF, 0xFFFF, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, ~std::uint64_t{0}};
    const std::uint64_t number = kNumbers[below(kNumbers.size())];
    const std::size_t size = std::size_t{2} << below(3);
    const bool is_big_endian = below(2) == 1;
    for (std::size_t i = 0; i < size && at + i < input.size(); ++i) {
      input[at + i] = static_cast<char>(number >> 8 * (is_big_endian ? size - 1 - i : i));
    }
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};

}  // namespace scantrove::test
