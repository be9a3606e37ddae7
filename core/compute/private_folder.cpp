#include "core/compute/private_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "scantrove-kernels-";
constexpr const char* kMarker = ".scantrove-private-kernels";

std::vector<fs::path> temporaryFolders() {
  std::vector<fs::path> folders;
  if (const char* chosen = std::getenv("TMPDIR"); chosen != nullptr && fs::path(chosen).is_absolute())
    folders.emplace_back(chosen);
  folders.insert(folders.end(), {"/tmp", "/var/tmp", "/dev/shm"});
  return folders;
}

/// Whether the folder belongs to this user and contains the marker as a regular file.
bool isOurs(const fs::path& folder) {
  struct stat status {
  }, marker{};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
         ::lstat((folder / kMarker).c_str(), &marker) == 0 && S_ISREG(marker.st_mode);
}

/// The marker stays locked while its program runs; the descriptor stays open.
bool lockMarker(const fs::path& folder) {
  const int file = ::open((folder / kMarker).c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) return false;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
  ::close(file);
  return false;
}

/// Removes folders of killed programs.
void removeAbandoned(const fs::path& in) {
  std::error_code failure;
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(in, failure), end; !failure && entry != end; entry.increment(failure)) {
    if (entry->path().filename().string().starts_with(kPrefix) && isOurs(entry->path()))
      abandoned.push_back(entry->path());
  }
  for (const fs::path& folder : abandoned) {
    if (lockMarker(folder)) fs::remove_all(folder, failure);
  }
}

}  // namespace

Result<fs::path> makePrivateFolder() {
  int reason = ENOENT;
  const std::vector<fs::path> candidates = temporaryFolders();
  for (const fs::path& in : candidates) {
    removeAbandoned(in);
    std::string name = (in / (std::string(kPrefix) + "XXXXXX")).string();
    if (::mkdtemp(name.data()) != nullptr && lockMarker(name)) return fs::path(name);
    if (in == candidates.front()) reason = errno;
  }
  return fail("Cannot make a folder in " + candidates.front().string() + " (" +
                  std::generic_category().message(reason) + ").",
              "Set TMPDIR to a folder that can be written to.");
}

void removePrivateFolder(const fs::path& folder) {
  std::error_code ignored;
  if (isOurs(folder)) fs::remove_all(folder, ignored);
}

}  // namespace scantrove
