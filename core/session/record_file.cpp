#include "core/session/record_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

#include "core/base/held_file.h"
#include "core/session/session_files.h"

namespace scantrove {
namespace {

Error fileFailure(const char* doing, const std::filesystem::path& path, int code) {
  return {
      std::string(doing) + " " + path.string() + " failed: " + std::generic_category().message(code) + ".",
      "Check the disk, its free space and the folder's permissions."};
}

}  // namespace

Result<RecordFile> RecordFile::create(const std::filesystem::path& path) {
  return openWith(path, O_CREAT | O_EXCL);
}

Result<RecordFile> RecordFile::open(const std::filesystem::path& path) { return openWith(path, 0); }

Result<RecordFile> RecordFile::openWith(const std::filesystem::path& path, int flags) {
  // Opening a pipe would wait for its other end.
  const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | flags, 0666);
  if (file < 0 && errno == ELOOP) return fail(isALink(path));
  if (file < 0) return fail(fileFailure("Opening", path, errno));
  RecordFile opened(path, file);
  struct stat status {};
  if (::fstat(file, &status) != 0) return fail(fileFailure("Reading", path, errno));
  if (!S_ISREG(status.st_mode))
    return fail(path.string() + " is no regular file.", "Restore it from a copy if there is one.");
  opened.end_ = static_cast<std::uint64_t>(status.st_size);
  return opened;
}

bool RecordFile::isStillThere() const { return isNameOf(path_, file_); }

RecordFile::RecordFile(RecordFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), end_(other.end_) {}

RecordFile& RecordFile::operator=(RecordFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(end_, other.end_);
  return *this;
}

RecordFile::~RecordFile() {
  if (file_ >= 0) ::close(file_);
}

Result<std::uint64_t> RecordFile::append(const PackedWords& packed) {
  std::span<const char> left = packed.bytes;
  std::uint64_t at = end_;
  while (!left.empty()) {
    const ssize_t written = ::pwrite(file_, left.data(), left.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    // A partly written record lies behind the end and is overwritten.
    if (written <= 0) return fail(fileFailure("Writing", path_, written < 0 ? errno : ENOSPC));
    left = left.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
  return std::exchange(end_, at);
}

Result<void> RecordFile::flush() {
  if (::fdatasync(file_) != 0) return fail(fileFailure("Writing", path_, errno));
  return {};
}

Result<std::vector<char>> RecordFile::read(std::uint64_t offset, std::uint64_t bytes) const {
  if (offset > end_ || bytes > end_ - offset)
    return fail("The file " + path_.string() + " is shorter than it was.",
                "A part of the map is missing; restore the file from a copy if there is one.");
  std::vector<char> result(bytes);
  std::span<char> left = result;
  while (!left.empty()) {
    const ssize_t got = ::pread(file_, left.data(), left.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return fail(fileFailure("Reading", path_, got < 0 ? errno : EIO));
    left = left.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
  return result;
}

}  // namespace scantrove
