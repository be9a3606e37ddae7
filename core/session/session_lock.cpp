#include "core/session/session_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace scantrove {

Result<SessionLock> SessionLock::take(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "session.lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    return fail("The session " + folder.string() +
                    " cannot be used: " + std::generic_category().message(errno) + " (session.lock).",
                "Give write permission to the folder, or use a copy of it.");
  }
  SessionLock lock(file);
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    return fail("The session " + folder.string() + " is in use by another program.",
                "Wait until that is done, or use a copy of the folder.");
  }
  return lock;
}

SessionLock::SessionLock(SessionLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

SessionLock& SessionLock::operator=(SessionLock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

SessionLock::~SessionLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace scantrove
