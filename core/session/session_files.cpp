#include "core/session/session_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFewestDigits = 6;

/// `000123` and one of `endings`.
template <std::size_t N>
bool isNumbered(std::string_view name, const std::array<std::string_view, N>& endings) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  return digits >= kFewestDigits && std::ranges::find(endings, name.substr(digits)) != endings.end();
}

bool isMapFile(std::string_view name) { return isNumbered(name, std::array<std::string_view, 1>{".bricks"}); }

bool isKeyFrameFile(std::string_view name) {
  return isNumbered(name,
                    std::array<std::string_view, 4>{".depth.png", ".color.png", ".color.jpg", ".color.jpeg"});
}

struct Part {
  const char* folder;
  bool (*is_ours)(std::string_view);
};
constexpr std::array kParts{Part{"map", isMapFile}, Part{"keyframes", isKeyFrameFile}};

std::vector<fs::directory_entry> entriesOf(const fs::path& folder) {
  std::vector<fs::directory_entry> entries;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    entries.push_back(*entry);
  return entries;
}

bool isOurs(const Part& part, const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.symlink_status(ignored).type() == fs::file_type::regular &&
         part.is_ours(entry.path().filename().string());
}

bool isUnfinished(const fs::path& path) {
  return path.filename().string().starts_with('.') && path.extension() == ".part";
}

}  // namespace

std::optional<fs::path> findForeignFile(const fs::path& folder) {
  for (const Part& part : kParts) {
    for (const fs::directory_entry& entry : entriesOf(folder / part.folder)) {
      if (!isOurs(part, entry) && !isUnfinished(entry.path())) return entry.path();
    }
  }
  return std::nullopt;
}

Result<void> removeSessionFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const Part& part : kParts) {
    for (const fs::directory_entry& entry : entriesOf(folder / part.folder)) {
      if (isOurs(part, entry)) files.push_back(entry.path());
    }
  }
  for (const char* name : {"session.sqlite-wal", "session.sqlite-shm", "session.sqlite"})
    files.push_back(folder / name);
  for (const fs::path& file : files) {
    std::error_code failure;
    fs::remove(file, failure);
    if (failure) {
      return fail("The earlier scan in " + folder.string() + " cannot be removed: " + failure.message() + ".",
                  "Check the permissions of the folder, or name another one.");
    }
  }
  return {};
}

Result<void> flushFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool is_done = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (is_done) return {};
  return fail("Writing " + folder.string() + " failed: " + std::generic_category().message(code) + ".",
              "Check the disk, its free space and the folder's permissions.");
}

}  // namespace scantrove
