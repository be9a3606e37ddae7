#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// What is locked belongs to one program at a time. The lock leaves nothing in a folder; it ends with the
/// object, and with the process however that ends.
class FileLock {
 public:
  /// Of a folder that is there, or of a file, which is made where there is none. Error: `taken`, as another
  /// one has it; or it cannot be opened.
  [[nodiscard]] static Result<FileLock> take(const std::filesystem::path& path, const Error& taken);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace scantrove
