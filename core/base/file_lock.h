#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// An exclusive lock between programs. It leaves no file in a folder, and ends with the object or the
/// process, however that ends.
class FileLock {
 public:
  /// Locks an existing folder, or a file, which is created if missing. Error: `taken` by another program; or
  /// it cannot be opened.
  [[nodiscard]] static Result<FileLock> take(const std::filesystem::path& path, const Error& taken);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace scantrove
