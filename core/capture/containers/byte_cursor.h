#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace scantrove {

using ByteBlock = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Reads numbers and texts from foreign bytes. Beyond the end it returns zeros and isOk() becomes false. One
/// thread.
class ByteCursor {
 public:
  explicit ByteCursor(ByteView bytes, bool is_big_endian = false)
      : bytes_(bytes), is_big_endian_(is_big_endian) {}

  [[nodiscard]] bool isOk() const { return is_ok_; }
  [[nodiscard]] std::size_t left() const { return is_ok_ ? bytes_.size() - at_ : 0; }
  [[nodiscard]] std::size_t position() const { return at_; }

  template <class Number>
  [[nodiscard]] Number get() {
    static_assert(std::is_arithmetic_v<Number>);
    const ByteView taken = take(sizeof(Number));
    std::uint8_t ordered[sizeof(Number)] = {};
    const bool is_to_swap = is_big_endian_ != (std::endian::native == std::endian::big);
    for (std::size_t i = 0; i < taken.size(); ++i)
      ordered[is_to_swap ? sizeof(Number) - 1 - i : i] = taken[i];
    Number value{};
    std::memcpy(&value, ordered, sizeof(Number));
    return value;
  }

  /// The next bytes; empty if so many are not left. Points into the bytes.
  [[nodiscard]] ByteView take(std::uint64_t count) {
    is_ok_ = is_ok_ && count <= bytes_.size() - at_;
    if (!is_ok_) return {};
    const ByteView taken = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += taken.size();
    return taken;
  }
  [[nodiscard]] std::string_view takeText(std::uint64_t count) {
    const ByteView taken = take(count);
    return {reinterpret_cast<const char*>(taken.data()), taken.size()};
  }
  void skip(std::uint64_t count) { static_cast<void>(take(count)); }

  /// Skips to a multiple of `unit` bytes from the start.
  void align(std::size_t unit) { skip((unit - at_ % unit) % unit); }

 private:
  ByteView bytes_;
  bool is_big_endian_;
  std::size_t at_ = 0;
  bool is_ok_ = true;
};

}  // namespace scantrove
