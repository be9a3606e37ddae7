#include "core/base/held_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

namespace scantrove {

bool isNameOf(const std::filesystem::path& path, int descriptor) {
  struct stat named {
  }, held{};
  return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor, &held) == 0 &&
         named.st_dev == held.st_dev && named.st_ino == held.st_ino;
}

std::optional<HeldFile> HeldFile::hold(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  HeldFile held(path, file);
  struct stat status {};
  if (::fstat(file, &status) != 0 || S_ISLNK(status.st_mode)) return std::nullopt;
  return held;
}

HeldFile::HeldFile(HeldFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

HeldFile& HeldFile::operator=(HeldFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  return *this;
}

HeldFile::~HeldFile() {
  if (file_ >= 0) ::close(file_);
}

HeldFile::Place HeldFile::place() const {
  if (isNameOf(path_, file_)) return Place::same;
  struct stat status {};
  if (::lstat(path_.c_str(), &status) == 0) return Place::replaced;
  if (::fstat(file_, &status) != 0 || status.st_nlink == 0) return Place::removed;
  return Place::moved;
}

std::filesystem::path HeldFile::nameNow() const {
  std::error_code failure;
  std::filesystem::path name =
      std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file_), failure);
  return !failure && isNameOf(name, file_) ? name : std::filesystem::path();
}

}  // namespace scantrove
