#include "core/exchange/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace scantrove {

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) {
    return fail(
        "The folder " + folder.string() + " cannot be used: " + std::generic_category().message(errno) + '.',
        "Give read and write permission to the folder, or choose another one.");
  }
  FolderLock lock(opened);
  // Where a file system has no locks, an unlocked folder is as good.
  if (::flock(opened, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return fail("Another program is writing to the folder " + folder.string() + '.', "Choose another one.");
  }
  return lock;
}

FolderLock::FolderLock(FolderLock&& other) noexcept : folder_(std::exchange(other.folder_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(folder_, other.folder_);
  return *this;
}

FolderLock::~FolderLock() {
  if (folder_ >= 0) ::close(folder_);
}

}  // namespace scantrove
