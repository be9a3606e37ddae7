#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace scantrove {

/// Serialises values by their bytes in memory, padded to 32-bit words. One thread.
class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    putAll(std::span<const T>(&value, 1));
  }
  /// Writes the values without their number, which a reader must know.
  template <class T>
  void putAll(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (values.empty()) return;
    const std::size_t first = words_.size();
    words_.resize(first + (values.size_bytes() + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t), 0);
    std::memcpy(words_.data() + first, values.data(), values.size_bytes());
  }
  /// Writes the number of values first.
  template <class T>
  void putList(std::span<const T> values) {
    put(static_cast<std::uint64_t>(values.size()));
    putAll(values);
  }

  [[nodiscard]] std::vector<std::uint32_t> take() { return std::exchange(words_, {}); }

 private:
  std::vector<std::uint32_t> words_;
};

/// Reads the output of a ByteWriter. On missing data ok() becomes false and zeros are returned. One thread.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint32_t> words) : left_(words) {}

  template <class T>
  [[nodiscard]] T get() {
    T value{};
    getAll(std::span<T>(&value, 1));
    return value;
  }
  template <class T>
  void getAll(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t words = (values.size_bytes() + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t);
    is_ok_ = is_ok_ && words <= left_.size();
    if (!is_ok_ || values.empty()) return;
    std::memcpy(static_cast<void*>(values.data()), left_.data(), values.size_bytes());
    left_ = left_.subspan(words);
  }
  template <class T>
  [[nodiscard]] std::vector<T> getList() {
    const auto count = get<std::uint64_t>();
    is_ok_ = is_ok_ && count <= left_.size_bytes() / sizeof(T);
    std::vector<T> values(is_ok_ ? count : 0);
    getAll(std::span<T>(values));
    return values;
  }

  /// Marks the data as invalid.
  void refuse() { is_ok_ = false; }
  [[nodiscard]] bool ok() const { return is_ok_; }
  [[nodiscard]] std::size_t bytesLeft() const { return is_ok_ ? left_.size_bytes() : 0; }
  /// Whether all data was present and nothing is left.
  [[nodiscard]] bool isAtEnd() const { return is_ok_ && left_.empty(); }

 private:
  std::span<const std::uint32_t> left_;
  bool is_ok_ = true;
};

}  // namespace scantrove
