#include "core/dataset/staged_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartSuffix = ".part-";
constexpr std::size_t kPartLetters = 6;

std::string systemReason(int code) { return std::generic_category().message(code); }

tl::unexpected<Error> cannotMake(const fs::path& place, const std::string& why) {
  return fail(
      "Cannot write the folder " + place.string() + ": " + why + ".",
      "Check that its parent can be written to and that the disk is not full, or choose another folder.");
}

/// Absolute, with links resolved, without a trailing slash, as a rename requires.
fs::path placeOf(const fs::path& folder) {
  std::error_code failure;
  fs::path place = fs::weakly_canonical(fs::absolute(folder), failure);
  if (failure) place = fs::absolute(folder).lexically_normal();
  return place.has_filename() ? place : place.parent_path();
}

bool isPartOf(const std::string& name, const std::string& place_name) {
  if (name.size() != place_name.size() + kPartSuffix.size() + kPartLetters) return false;
  if (name.compare(0, place_name.size(), place_name) != 0) return false;
  if (name.compare(place_name.size(), kPartSuffix.size(), kPartSuffix) != 0) return false;
  return std::all_of(name.end() - static_cast<std::ptrdiff_t>(kPartLetters), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

/// Creates a folder of an unused name with the default permissions. mkdtemp would restrict it to its owner,
/// and a process cannot read its umask without affecting other threads.
Result<fs::path> makePartOf(const fs::path& place) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> any(0, kLetters.size() - 1);
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name = place.string() + std::string(kPartSuffix);
    for (std::size_t i = 0; i < kPartLetters; ++i) name += kLetters[any(random)];
    if (::mkdir(name.c_str(), 0777) == 0) return fs::path(name);
    if (errno != EEXIST) break;
  }
  return cannotMake(place, systemReason(errno));
}

/// The marker's content. It names the staged folder, so that a renamed copy does not count as ours.
std::string markerOf(const fs::path& part) {
  return "Scantrove has not finished this folder. The next export to the same place removes " +
         part.filename().string() + ".\n";
}

Result<void> writeMarker(const fs::path& part, const fs::path& place) {
  const int file = ::open((part / StagedFolder::kMarker).c_str(),
                          O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0) return cannotMake(place, systemReason(errno));
  const std::string text = markerOf(part);
  const bool is_written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int code = errno;
  ::close(file);
  return is_written ? Result<void>() : cannotMake(place, systemReason(code));
}

/// Whether this program created the open `folder` and has not finished it.
bool isMarked(int folder, const fs::path& part) {
  const int file = ::openat(folder, StagedFolder::kMarker, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  const std::string expected = markerOf(part);
  std::string content(expected.size() + 1, '\0');
  const ssize_t read = ::read(file, content.data(), content.size());
  ::close(file);
  content.resize(static_cast<std::size_t>(std::max<ssize_t>(read, 0)));
  return content == expected;
}

int openFolder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
}

/// Removes the staged folders that killed programs left beside `place`: those with our marker that nobody
/// has locked.
void removeAbandoned(const fs::path& place) {
  std::error_code ignored;
  for (fs::directory_iterator entry(place.parent_path(), ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (!isPartOf(entry->path().filename().string(), place.filename().string())) continue;
    const int folder = openFolder(entry->path());
    if (folder < 0) continue;
    std::error_code not_removed;
    if (isMarked(folder, entry->path()) && ::flock(folder, LOCK_EX | LOCK_NB) == 0)
      fs::remove_all(entry->path(), not_removed);
    ::close(folder);
  }
}

/// Syncs the file system of `folder` once, because a data set has thousands of files.
Result<void> flushDiskOf(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool done = descriptor >= 0 && ::syncfs(descriptor) == 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (done) return {};
  return fail("Cannot write " + folder.string() + ": " + systemReason(code) + ".",
              "Check that the disk is not full and not failing.");
}

Result<void> checkPlace(const fs::path& place) {
  std::error_code failure;
  const fs::file_type type = fs::status(place, failure).type();
  if (type == fs::file_type::not_found) return {};
  if (type != fs::file_type::directory && type != fs::file_type::none && type != fs::file_type::unknown) {
    return fail(place.string() + " is there already and is no folder.", "Give the name of a new folder.");
  }
  const bool is_empty = !failure && fs::is_empty(place, failure);
  if (failure) return cannotMake(place, failure.message());
  if (is_empty) return {};
  return fail("The folder " + place.string() + " is not empty.",
              "Give a new folder for the export, or empty this one.");
}

}  // namespace

StagedFolder::StagedFolder(fs::path place, fs::path path, int lock)
    : place_(std::move(place)), path_(std::move(path)), lock_(lock) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : place_(std::move(other.place_)),
      path_(std::exchange(other.path_, {})),
      lock_(std::exchange(other.lock_, -1)) {}

StagedFolder& StagedFolder::operator=(StagedFolder&& other) noexcept {
  if (this != &other) {
    discard();
    place_ = std::move(other.place_);
    path_ = std::exchange(other.path_, {});
    lock_ = std::exchange(other.lock_, -1);
  }
  return *this;
}

StagedFolder::~StagedFolder() { discard(); }

void StagedFolder::discard() noexcept {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  path_.clear();
  if (lock_ >= 0) ::close(std::exchange(lock_, -1));
}

Result<StagedFolder> StagedFolder::create(const fs::path& folder) {
  if (folder.empty()) return fail("No folder was given for the export.", "Give the name of a new folder.");
  std::error_code failure;
  if (fs::is_symlink(folder, failure) && fs::status(folder, failure).type() == fs::file_type::not_found) {
    return fail(folder.string() + " is a link to " + fs::read_symlink(folder, failure).string() +
                    ", which does not exist.",
                "Make that folder, or give another one.");
  }
  const fs::path place = placeOf(folder);
  SCANTROVE_TRY(checkPlace(place));
  fs::create_directories(place.parent_path(), failure);
  if (failure) return cannotMake(place, failure.message());
  removeAbandoned(place);
  const Result<fs::path> part = makePartOf(place);
  if (!part) return fail(part.error());
  const int lock = openFolder(*part);
  // If a file system has no locks, an unlocked folder is accepted.
  if (lock >= 0) (void)::flock(lock, LOCK_EX | LOCK_NB);
  StagedFolder staged(place, *part, lock);
  SCANTROVE_TRY(writeMarker(*part, place));
  return staged;
}

Result<void> StagedFolder::commit() {
  SCANTROVE_TRY(flushDiskOf(path_));
  // Removed before the rename: a finished folder never contains the marker, even after a crash.
  if (::unlink((path_ / kMarker).c_str()) != 0 && errno != ENOENT)
    return cannotMake(place_, systemReason(errno));
  if (::rename(path_.c_str(), place_.c_str()) != 0) {
    const int code = errno;
    if (code == ENOTEMPTY || code == EEXIST || code == ENOTDIR) {
      return fail("Something has been put into " + place_.string() + " while the export ran.",
                  "Give another folder and export again.");
    }
    return cannotMake(place_, systemReason(code));
  }
  path_.clear();
  return flushDiskOf(place_.parent_path());
}

Error StagedFolder::inFinalWords(Error error) const {
  const std::string staged = path_.string();
  for (std::string* text : {&error.what, &error.advice}) {
    for (std::size_t at = 0; !staged.empty() && (at = text->find(staged, at)) != std::string::npos;) {
      text->replace(at, staged.size(), place_.string());
      at += place_.string().size();
    }
  }
  return error;
}

}  // namespace scantrove
