#include "core/dataset/staged_remains.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "core/dataset/export_record.h"
#include "core/dataset/staged_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// The texts of a marker around the name of its folder.
struct MarkerText {
  std::string_view before, after;
};
constexpr MarkerText kStagedText{
    "Scantrove has not finished this folder. The next export to the same place removes ", ".\n"};
constexpr MarkerText kReplacedText{
    "Scantrove was replacing this data set. The next export to the same place restores or removes ", ".\n"};

std::string markerOf(const MarkerText& text, const fs::path& part) {
  return std::string(text.before) + part.filename().string() + std::string(text.after);
}

/// Whether this may be the name of a staged folder of some place.
bool isPartName(std::string_view name) {
  constexpr std::size_t kEnd = kStagedSuffix.size() + kStagedLetters;
  if (name.size() <= kEnd || name.find('/') != std::string_view::npos) return false;
  const std::string_view end = name.substr(name.size() - kEnd);
  return end.starts_with(kStagedSuffix) &&
         std::ranges::all_of(end.substr(kStagedSuffix.size()),
                             [](unsigned char c) { return std::isalnum(c) != 0; });
}

bool isPartOf(const std::string& name, const std::string& place_name) {
  return isPartName(name) && name.size() == place_name.size() + kStagedSuffix.size() + kStagedLetters &&
         name.starts_with(place_name);
}

bool isMarker(std::string_view content, const MarkerText& text) {
  if (content.size() < text.before.size() + text.after.size()) return false;
  if (!content.starts_with(text.before) || !content.ends_with(text.after)) return false;
  content.remove_prefix(text.before.size());
  content.remove_suffix(text.after.size());
  return isPartName(content);
}

/// The content of the marker in the open `folder`, up to the longest that one has; empty: there is none.
std::string markerIn(int folder) {
  constexpr std::size_t kLongest = 1024;  // a file name has at most 255 bytes
  const int file = ::openat(folder, StagedFolder::kMarker, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {};
  std::string content(kLongest, '\0');
  const ssize_t read = ::read(file, content.data(), content.size());
  ::close(file);
  content.resize(static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
  return content;
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
    (*record)->removeFrom(part);
    return;
  }
  std::error_code not_removed;
  fs::remove_all(part, not_removed);
}

}  // namespace

std::string stagedMarkerOf(const fs::path& part) { return markerOf(kStagedText, part); }

std::string replacedMarkerOf(const fs::path& part) { return markerOf(kReplacedText, part); }

bool hasOurMarker(const fs::path& folder) {
  const int open = openStagedFolder(folder);
  if (open < 0) return false;
  const std::string content = markerIn(open);
  ::close(open);
  return isMarker(content, kStagedText) || isMarker(content, kReplacedText);
}

void removeOurMarker(const fs::path& folder) {
  if (hasOurMarker(folder)) ::unlink((folder / StagedFolder::kMarker).c_str());
}

bool writeStagedMarker(const fs::path& folder, const std::string& text) {
  const fs::path marker = folder / StagedFolder::kMarker;
  removeOurMarker(folder);
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
    if (is_restored || markerIn(folder) != replacedMarkerOf(part)) return;
    is_restored = ::rename(part.c_str(), place.c_str()) == 0;
    if (is_restored) removeOurMarker(place);
  });
}

void removeAbandonedFolders(const fs::path& place) {
  forEachPartOf(place, [](const fs::path& part, int folder) {
    const std::string marker = markerIn(folder);
    const bool is_ours = marker == stagedMarkerOf(part) || marker == replacedMarkerOf(part);
    if (is_ours && ::flock(folder, LOCK_EX | LOCK_NB) == 0) removePart(part);
  });
}

}  // namespace scantrove
