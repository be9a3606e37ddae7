#include "core/session/session_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "core/session/own_files.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::vector<fs::directory_entry> entriesOf(const fs::path& folder) {
  std::vector<fs::directory_entry> entries;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    entries.push_back(*entry);
  return entries;
}

bool hasFormOfOurs(const fs::path& part, const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.symlink_status(ignored).type() == fs::file_type::regular &&
         own_files::hasFormOfOurs(part / entry.path().filename());
}

bool isUnfinished(const fs::path& path) {
  return path.filename().string().starts_with('.') && path.extension() == ".part";
}

Result<void> flush(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | flags);
  const bool is_done = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (is_done) return {};
  return fail("Writing " + path.string() + " failed: " + std::generic_category().message(code) + ".",
              "Check the disk, its free space and the folder's permissions.");
}

}  // namespace

std::optional<fs::path> findForeignFile(const fs::path& folder) {
  for (const char* part : {"map", "keyframes"}) {
    for (const fs::directory_entry& entry : entriesOf(folder / part)) {
      if (!hasFormOfOurs(part, entry) && !isUnfinished(entry.path())) return entry.path();
    }
  }
  return std::nullopt;
}

Error isALink(const fs::path& path) {
  return {path.string() + " is a symbolic link; a session writes into its own folder only.",
          "Put the file or folder itself there."};
}

Result<void> checkHasNoLinks(const fs::path& folder) {
  for (const char* name : {"map", "keyframes", "session.lock", "session.sqlite", "session.sqlite-wal",
                           "session.sqlite-shm", "session.sqlite-journal"}) {
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(folder / name, ignored))) return fail(isALink(folder / name));
  }
  return {};
}

Result<void> makeSessionFolders(const fs::path& folder) {
  std::error_code failure;
  for (const fs::path& path : {folder, folder / "map", folder / "keyframes"}) {
    fs::create_directories(path, failure);
    if (failure) {
      return fail("The folder " + path.string() + " cannot be made: " + failure.message() + ".",
                  "Check the name and the permissions of the folder above.");
    }
  }
  return checkHasNoLinks(folder);
}

Result<void> flushFolder(const fs::path& folder) { return flush(folder, O_DIRECTORY); }

Result<void> flushFile(const fs::path& file) { return flush(file, O_NOFOLLOW); }

}  // namespace scantrove
