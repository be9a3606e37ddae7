#include "core/base/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace scantrove {

namespace {

tl::unexpected<Error> cannotRead(const std::filesystem::path& file, int code) {
  return fail("Cannot read " + file.string() + ": " + std::generic_category().message(code) + ".",
              "Check the path and its permissions.");
}

Result<void> checkMode(const std::filesystem::path& file, mode_t mode) {
  if (S_ISREG(mode)) {
    return {};
  }
  const char* const kind = S_ISDIR(mode)    ? "a folder"
                           : S_ISFIFO(mode) ? "a pipe"
                           : S_ISSOCK(mode) ? "a socket"
                                            : "a device";
  return fail(file.string() + " is " + kind + ", not a file.", "Give a file on a disk.");
}

class OpenFile {
 public:
  // Open without blocking, in case a pipe replaced the file after the check.
  explicit OpenFile(const std::filesystem::path& file)
      : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

Result<void> checkRegularFile(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    return cannotRead(file, errno);
  }
  return checkMode(file, status.st_mode);
}

Result<std::string> readFile(const std::filesystem::path& file, std::size_t limit) {
  SCANTROVE_TRY(checkRegularFile(file));
  const OpenFile open(file);
  struct stat status {};
  if (open.descriptor() < 0 || ::fstat(open.descriptor(), &status) != 0) {
    return cannotRead(file, errno);
  }
  SCANTROVE_TRY(checkMode(file, status.st_mode));
  std::string bytes;
  const auto expected = static_cast<std::size_t>(status.st_size);
  while (bytes.size() < limit) {
    // One byte more than expected, so that an unchanged file is read in one piece.
    constexpr std::size_t kMinPiece = 4096;
    const std::size_t had = bytes.size();
    const std::size_t missing = expected >= had ? expected - had + 1 : 0;
    bytes.resize(had + std::min(limit - had, std::max(missing, kMinPiece)));
    const ssize_t got = ::read(open.descriptor(), bytes.data() + had, bytes.size() - had);
    bytes.resize(had + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got < 0 && errno != EINTR) {
      return cannotRead(file, errno);
    }
    if (got == 0) {
      break;
    }
  }
  return bytes;
}

}  // namespace scantrove
