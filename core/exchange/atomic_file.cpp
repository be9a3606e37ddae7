#include "core/exchange/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <sstream>
#include <string>
#include <system_error>

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why) {
  return fail("Cannot write " + path.string() + ": " + why + ".",
              "Check that the folder can be written to and that the disk is not full.");
}

/// Hidden, in the same folder (a rename must not cross file systems), of the same extension, of this process
/// only.
fs::path nameBeside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  std::ostringstream name;
  name << '.' << path.stem().string() << '.' << ::getpid() << '-' << counter++ << ".part"
       << path.extension().string();
  return path.parent_path() / name.str();
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

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
  bool close() {
    const bool closed = fd_ < 0 || ::close(fd_) == 0;
    fd_ = -1;
    return closed;
  }

 private:
  int fd_;
};

/// Removes the file beside unless it was renamed.
class FileBeside {
 public:
  explicit FileBeside(const fs::path& path) : path_(nameBeside(path)) {}
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;
  ~FileBeside() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A renamed file survives a power cut only once its folder is on the disk as well.
void flushFolder(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.isOpen()) (void)descriptor.flush();
}

Result<void> renameTo(const fs::path& path, const FileBeside& beside, Durability durability) {
  std::error_code failure;
  fs::rename(beside.path(), path, failure);
  if (failure) return cannotWrite(path, failure.message());
  if (durability == Durability::power) flushFolder(path);
  return {};
}

}  // namespace

Result<void> writeFileAtomically(const fs::path& path, std::string_view bytes, Durability durability) {
  const FileBeside beside(path);
  Descriptor file(beside.path(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.isOpen() || !file.writeAll(bytes) || (durability == Durability::power && !file.flush()) ||
      !file.close()) {
    return cannotWrite(path, reason(errno));
  }
  return renameTo(path, beside, durability);
}

Result<void> writeFileAtomically(const fs::path& path,
                                 const std::function<Result<void>(const fs::path&)>& write,
                                 Durability durability) {
  const FileBeside beside(path);
  // Opening it first gives the system's own reason where the library that writes would only say "failed".
  if (const Descriptor probe(beside.path(), O_WRONLY | O_CREAT | O_TRUNC); !probe.isOpen()) {
    return cannotWrite(path, reason(errno));
  }
  if (auto written = write(beside.path()); !written) return cannotWrite(path, written.error().what);
  if (durability == Durability::power) {
    const Descriptor file(beside.path(), O_RDONLY);
    if (!file.isOpen() || !file.flush()) return cannotWrite(path, reason(errno));
  }
  return renameTo(path, beside, durability);
}

Result<void> prepareOutputFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) {
    return fail("Cannot create the folder " + folder.string() + ": " + failure.message() + ".",
                "Choose another output folder.");
  }
  const FileBeside probe(folder / "probe");
  const Descriptor file(probe.path(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.isOpen() || !file.writeAll("x")) {
    return fail("Cannot write to the folder " + folder.string() + ": " + reason(errno) + ".",
                "Choose another output folder.");
  }
  return {};
}

}  // namespace scantrove
