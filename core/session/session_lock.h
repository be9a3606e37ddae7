#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// A session's folder belongs to one program at a time. Ends with the object, and with the process however
/// that ends.
class SessionLock {
 public:
  /// Error: another program has it, or the folder cannot be written.
  [[nodiscard]] static Result<SessionLock> take(const std::filesystem::path& folder);
  SessionLock(SessionLock&& other) noexcept;
  SessionLock& operator=(SessionLock&& other) noexcept;
  ~SessionLock();

 private:
  explicit SessionLock(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace scantrove
