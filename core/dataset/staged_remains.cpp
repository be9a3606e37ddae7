#include "core/dataset/staged_remains.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <system_error>

#include "core/dataset/export_record.h"
#include "core/dataset/staged_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

bool isPartOf(const std::string& name, const std::string& place_name) {
  if (name.size() != place_name.size() + kStagedSuffix.size() + kStagedLetters) return false;
  if (name.compare(0, place_name.size(), place_name) != 0) return false;
  if (name.compare(place_name.size(), kStagedSuffix.size(), kStagedSuffix) != 0) return false;
  return std::all_of(name.end() - static_cast<std::ptrdiff_t>(kStagedLetters), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

/// Whether the marker of the open `folder` is `expected`.
bool hasMarker(int folder, const std::string& expected) {
  const int file = ::openat(folder, StagedFolder::kMarker, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  std::string content(expected.size() + 1, '\0');
  const ssize_t read = ::read(file, content.data(), content.size());
  ::close(file);
  content.resize(static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
  return content == expected;
}

/// Calls `use` with each staged folder of `place` and its descriptor.
void forEachPartOf(const fs::path& place, const std::function<void(const fs::path&, int)>& use) {
  std::error_code ignored;
  for (fs::directory_iterator entry(place.parent_path(), ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (!isPartOf(entry->path().filename().string(), place.filename().string())) continue;
    const int folder = openStagedFolder(entry->path());
    if (folder < 0) continue;
    use(entry->path(), folder);
    ::close(folder);
  }
}

void removePart(const fs::path& part) {
  const auto record = ExportRecord::read(part);
  if (!record) return;  // unreadable: it may be a data set of before, of which nobody can say what is ours
  if (*record) {
    (*record)->removeFrom(part, StagedFolder::kMarker);
    return;
  }
  std::error_code not_removed;
  fs::remove_all(part, not_removed);
}

}  // namespace

std::string stagedMarkerOf(const fs::path& part) {
  return "Scantrove has not finished this folder. The next export to the same place removes " +
         part.filename().string() + ".\n";
}

std::string replacedMarkerOf(const fs::path& part) {
  return "Scantrove was replacing this data set. The next export to the same place restores or removes " +
         part.filename().string() + ".\n";
}

bool writeStagedMarker(const fs::path& folder, const std::string& text) {
  const fs::path marker = folder / StagedFolder::kMarker;
  ::unlink(marker.c_str());
  const int file = ::open(marker.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) return false;
  const bool is_written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int code = errno;
  ::close(file);
  errno = code;
  return is_written;
}

int openStagedFolder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
}

void restoreReplacedFolder(const fs::path& place) {
  std::error_code unknown;
  if (fs::symlink_status(place, unknown).type() != fs::file_type::not_found) return;
  bool is_restored = false;
  forEachPartOf(place, [&](const fs::path& part, int folder) {
    if (is_restored || !hasMarker(folder, replacedMarkerOf(part))) return;
    is_restored = ::rename(part.c_str(), place.c_str()) == 0;
    if (is_restored) ::unlink((place / StagedFolder::kMarker).c_str());
  });
}

void removeAbandonedFolders(const fs::path& place) {
  forEachPartOf(place, [](const fs::path& part, int folder) {
    const bool is_ours = hasMarker(folder, stagedMarkerOf(part)) || hasMarker(folder, replacedMarkerOf(part));
    if (is_ours && ::flock(folder, LOCK_EX | LOCK_NB) == 0) removePart(part);
  });
}

}  // namespace scantrove
