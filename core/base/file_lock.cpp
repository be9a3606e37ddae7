#include "core/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace scantrove {

Result<FileLock> FileLock::take(const std::filesystem::path& path, const Error& taken) {
  std::error_code ignored;
  const int how =
      std::filesystem::is_directory(path, ignored) ? O_RDONLY | O_DIRECTORY : O_RDWR | O_CREAT | O_NOFOLLOW;
  const int file = ::open(path.c_str(), how | O_CLOEXEC, 0666);
  if (file < 0) {
    return fail(path.string() + " cannot be used: " + std::generic_category().message(errno) + '.',
                "Give write permission to the folder, or use a copy of it.");
  }
  FileLock lock(file);
  // Continue without lock on file systems that have none.
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return fail(taken);
  return lock;
}

FileLock::FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace scantrove
