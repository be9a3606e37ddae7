#pragma once
#include <cstdint>
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/containers/byte_cursor.h"

namespace scantrove {

/// A regular file that is read in pieces at any place. One thread.
class RandomAccessFile {
 public:
  /// Error: names the file; not regular, or the system's reason.
  [[nodiscard]] static Result<RandomAccessFile> open(const std::filesystem::path& path);
  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  ~RandomAccessFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Exactly `count` bytes from `offset` on. Allocates nothing if they lie beyond the end. Error: names the
  /// file; it ends before, or the system's reason.
  [[nodiscard]] Result<ByteBlock> read(std::uint64_t offset, std::uint64_t count) const;

  /// At most `count` (up to 16 KiB) bytes from `offset` on, fewer at the end. The view is valid until the
  /// next call. Reads ahead, for walks over many small records. Error: the system's reason.
  [[nodiscard]] Result<ByteView> peek(std::uint64_t offset, std::size_t count);

 private:
  RandomAccessFile(std::filesystem::path path, int descriptor, std::uint64_t size)
      : path_(std::move(path)), descriptor_(descriptor), size_(size) {}
  [[nodiscard]] Result<std::size_t> readInto(std::span<std::uint8_t> target, std::uint64_t offset) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  ByteBlock window_;
  std::uint64_t window_offset_ = 0;
};

}  // namespace scantrove
