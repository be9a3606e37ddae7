#include "core/exchange/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "core/exchange/part_name.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why) {
  return fail("Cannot write " + path.string() + ": " + why + ".",
              "Check that the folder can be written to and that the disk is not full.");
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }

  [[nodiscard]] bool isOpen() const { return fd_ >= 0; }
  [[nodiscard]] bool writeAll(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }
  [[nodiscard]] bool flush() const { return ::fsync(fd_) == 0; }
  /// Tries to lock the file. The lock lasts until the file is closed, also by a killed program.
  [[nodiscard]] bool lock() const { return ::flock(fd_, LOCK_EX | LOCK_NB) == 0; }
  /// Whether it is a regular file of this user with a single name.
  [[nodiscard]] bool isOwnFile() const {
    struct stat status {};
    return ::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
           status.st_nlink == 1;
  }
  /// Reports the errors of closing (network disks then report failed writes), but keeps the file open and
  /// locked.
  [[nodiscard]] bool settle() const {
    const int copy = ::dup(fd_);
    return copy >= 0 && ::close(copy) == 0;
  }

 private:
  int fd_;
};

/// A locked file in progress; removed unless it was renamed.
class PartFile {
 public:
  explicit PartFile(const fs::path& path)
      : path_(makePartName(path)), file_(path_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW) {
    // Continue without lock on file systems that have none.
    if (file_.isOpen()) (void)file_.lock();
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile() {
    std::error_code ignored;
    if (file_.isOpen()) fs::remove(path_, ignored);  // otherwise the name may belong to another program
  }
  [[nodiscard]] const fs::path& path() const { return path_; }
  /// Whether every byte reached the file, and the disk if requested.
  [[nodiscard]] bool fill(const std::function<std::string_view()>& next, Durability durability) const {
    if (!file_.isOpen()) return false;
    for (std::string_view bytes = next(); !bytes.empty(); bytes = next()) {
      if (!file_.writeAll(bytes)) return false;
    }
    return (durability != Durability::power || file_.flush()) && file_.settle();
  }

 private:
  fs::path path_;
  Descriptor file_;
};

std::function<std::string_view()> onePiece(std::string_view bytes) {
  return [bytes]() mutable { return std::exchange(bytes, {}); };
}

/// Removes part files of killed runs: this program's names, without a lock.
void removeAbandonedParts(const fs::path& folder) {
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (!isPartName(entry->path().filename().string()) || !fs::is_regular_file(entry->symlink_status()))
      continue;
    const Descriptor part(entry->path(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    if (part.isOpen() && part.isOwnFile() && part.lock()) fs::remove(entry->path(), ignored);
  }
}

/// A rename survives a power cut only after its folder was flushed to the disk.
void flushFolder(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.isOpen()) (void)descriptor.flush();
}

}  // namespace

Result<void> writeFileAtomically(const fs::path& path, std::string_view bytes, Durability durability) {
  return writeFileAtomically(path, onePiece(bytes), durability);
}

Result<void> writeFileAtomically(const fs::path& path, const std::function<std::string_view()>& next,
                                 Durability durability) {
  // A power cut must not lose the earlier file before the new one is on the disk.
  std::error_code ignored;
  if (fs::exists(path, ignored)) durability = Durability::power;
  const PartFile part(path);
  if (!part.fill(next, durability)) return cannotWrite(path, reason(errno));
  std::error_code failure;
  fs::rename(part.path(), path, failure);
  if (failure) return cannotWrite(path, failure.message());
  if (durability == Durability::power) flushFolder(path);
  return {};
}

Result<void> prepareOutputFolder(const fs::path& folder) {
  std::error_code failure;
  if (fs::is_symlink(folder, failure) && fs::status(folder, failure).type() == fs::file_type::not_found) {
    return fail(folder.string() + " is a link to " + fs::read_symlink(folder, failure).string() +
                    ", which does not exist.",
                "Make that folder, or choose another output folder.");
  }
  fs::create_directories(folder, failure);
  if (failure) {
    return fail("Cannot create the folder " + folder.string() + ": " + failure.message() + ".",
                "Choose another output folder.");
  }
  const PartFile probe(folder / "probe");
  if (!probe.fill(onePiece("x"), Durability::process)) {
    return fail("Cannot write to the folder " + folder.string() + ": " + reason(errno) + ".",
                "Choose another output folder.");
  }
  removeAbandonedParts(folder);
  return {};
}

Result<void> checkReplaceable(const fs::path& folder, std::span<const char* const> names) {
  for (const fs::path name : names) {
    std::error_code ignored;
    const fs::file_type type = fs::status(folder / name, ignored).type();
    if (type == fs::file_type::not_found || type == fs::file_type::regular) continue;
    return fail((folder / name).string() +
                    " is in the way: a result of that name will be written, and it is " +
                    (type == fs::file_type::directory ? "a folder." : "no file."),
                "Move it away, or choose another output folder.");
  }
  return {};
}

}  // namespace scantrove
