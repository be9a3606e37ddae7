#include "core/capture/containers/random_access_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/regular_file.h"

namespace scantrove {

namespace {

constexpr std::size_t kWindowBytes = 16 << 10;

tl::unexpected<Error> cannotReadContainer(const std::filesystem::path& path, int code) {
  return fail("Cannot read " + path.string() + ": " + std::generic_category().message(code) + ".",
              "Check the file, its permissions and its drive.");
}

}  // namespace

Result<RandomAccessFile> RandomAccessFile::open(const std::filesystem::path& path) {
  SCANTROVE_TRY(checkRegularFile(path));
  // Without blocking, in case a pipe replaced the file after the check.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) return cannotReadContainer(path, errno);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    const int code = errno;
    ::close(descriptor);
    return cannotReadContainer(path, code);
  }
  return RandomAccessFile(path, descriptor, static_cast<std::uint64_t>(status.st_size));
}

RandomAccessFile::RandomAccessFile(RandomAccessFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      window_(std::move(other.window_)),
      window_offset_(other.window_offset_) {}

RandomAccessFile& RandomAccessFile::operator=(RandomAccessFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  std::swap(window_, other.window_);
  std::swap(window_offset_, other.window_offset_);
  return *this;
}

RandomAccessFile::~RandomAccessFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<std::size_t> RandomAccessFile::readInto(std::span<std::uint8_t> target, std::uint64_t offset) const {
  std::size_t done = 0;
  while (done < target.size()) {
    const ssize_t got =
        ::pread(descriptor_, target.data() + done, target.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannotReadContainer(path_, errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

Result<ByteBlock> RandomAccessFile::read(std::uint64_t offset, std::uint64_t count) const {
  const auto ends = [&] {
    return fail(path_.string() + " ends before a record that it announces.", "Was it copied completely?");
  };
  if (offset > size_ || count > size_ - offset) return ends();
  ByteBlock bytes(static_cast<std::size_t>(count));
  const Result<std::size_t> got = readInto(bytes, offset);
  if (!got) return fail(got.error());
  if (*got < bytes.size()) return ends();
  return bytes;
}

Result<ByteView> RandomAccessFile::peek(std::uint64_t offset, std::size_t count) {
  count = std::min(count, kWindowBytes);
  const std::uint64_t end = window_offset_ + window_.size();
  const bool is_inside = offset >= window_offset_ && offset <= end &&
                         std::min(size_ - std::min(size_, offset), std::uint64_t{count}) <= end - offset;
  if (!is_inside) {
    window_.resize(kWindowBytes);
    window_offset_ = offset;
    const Result<std::size_t> got = offset < size_ ? readInto(window_, offset) : Result<std::size_t>(0);
    window_.resize(got ? *got : 0);
    if (!got) return fail(got.error());
  }
  const ByteView rest = ByteView(window_).subspan(static_cast<std::size_t>(offset - window_offset_));
  return rest.first(std::min(rest.size(), count));
}

}  // namespace scantrove
