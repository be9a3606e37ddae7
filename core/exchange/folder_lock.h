#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// A folder is written to by one program at a time. Leaves nothing in the folder; ends with the object, and
/// with the process however that ends.
class FolderLock {
 public:
  /// Error: another one has it, or the folder cannot be opened.
  [[nodiscard]] static Result<FolderLock> take(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  explicit FolderLock(int folder) : folder_(folder) {}
  int folder_ = -1;
};

}  // namespace scantrove
