#include "core/dataset/staged_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/dataset/staged_remains.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

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

/// Creates a folder of an unused name with the default permissions. mkdtemp would restrict it to its owner,
/// and a process cannot read its umask without affecting other threads.
Result<fs::path> makePartOf(const fs::path& place) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> any(0, kLetters.size() - 1);
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name = place.string() + std::string(kStagedSuffix);
    for (std::size_t i = 0; i < kStagedLetters; ++i) name += kLetters[any(random)];
    if (::mkdir(name.c_str(), 0777) == 0) return fs::path(name);
    if (errno != EEXIST) break;
  }
  return cannotMake(place, systemReason(errno));
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
  return {};
}

/// The record of the data set in a folder that is not empty; none: the folder is new or empty. Error: it has
/// anything that an export of `format` did not write, or that was changed since; names it.
Result<std::optional<ExportRecord>> replaceableIn(const fs::path& place, const std::string& format) {
  std::error_code failure;
  if (!fs::exists(place, failure)) return std::optional<ExportRecord>();
  const bool is_empty = fs::is_empty(place, failure);
  if (failure) return cannotMake(place, failure.message());
  if (is_empty) return std::optional<ExportRecord>();
  std::optional<ExportRecord> record;
  if (!format.empty()) SCANTROVE_TRY(moveInto(record, ExportRecord::read(place)));
  if (!record) {
    return fail("The folder " + place.string() + " is not empty.",
                "Give a new folder for the export, or empty this one.");
  }
  if (record->format() != format) {
    return fail("The folder " + place.string() + " has a data set of the format " + record->format() +
                    ", which an export of " + format + " does not replace.",
                "Give another folder.");
  }
  SCANTROVE_TRY(record->checkUnchanged(place));
  return record;
}

}  // namespace

StagedFolder::StagedFolder(fs::path place, fs::path path, int lock, std::optional<ExportRecord> replaced)
    : place_(std::move(place)), path_(std::move(path)), lock_(lock), replaced_(std::move(replaced)) {}

StagedFolder::StagedFolder(StagedFolder&& other) noexcept
    : place_(std::move(other.place_)),
      path_(std::exchange(other.path_, {})),
      left_over_(std::move(other.left_over_)),
      lock_(std::exchange(other.lock_, -1)),
      replaced_(std::move(other.replaced_)) {}

StagedFolder& StagedFolder::operator=(StagedFolder&& other) noexcept {
  if (this != &other) {
    discard();
    place_ = std::move(other.place_);
    path_ = std::exchange(other.path_, {});
    left_over_ = std::move(other.left_over_);
    lock_ = std::exchange(other.lock_, -1);
    replaced_ = std::move(other.replaced_);
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

Result<StagedFolder> StagedFolder::create(const fs::path& folder) { return createOver(folder, ""); }

Result<StagedFolder> StagedFolder::createOver(const fs::path& folder, const std::string& format) {
  if (folder.empty()) return fail("No folder was given for the export.", "Give the name of a new folder.");
  std::error_code failure;
  if (fs::is_symlink(folder, failure) && fs::status(folder, failure).type() == fs::file_type::not_found) {
    return fail(folder.string() + " is a link to " + fs::read_symlink(folder, failure).string() +
                    ", which does not exist.",
                "Make that folder, or give another one.");
  }
  const fs::path place = placeOf(folder);
  restoreReplacedFolder(place);
  SCANTROVE_TRY(checkPlace(place));
  auto replaced = replaceableIn(place, format);
  if (!replaced) return fail(replaced.error());
  fs::create_directories(place.parent_path(), failure);
  if (failure) return cannotMake(place, failure.message());
  removeAbandonedFolders(place);
  const Result<fs::path> part = makePartOf(place);
  if (!part) return fail(part.error());
  const int lock = openStagedFolder(*part);
  // If a file system has no locks, an unlocked folder is accepted.
  if (lock >= 0) (void)::flock(lock, LOCK_EX | LOCK_NB);
  StagedFolder staged(place, *part, lock, std::move(*replaced));
  if (!writeStagedMarker(*part, stagedMarkerOf(*part))) return cannotMake(place, systemReason(errno));
  return staged;
}

Result<void> StagedFolder::commit() {
  SCANTROVE_TRY(flushDiskOf(path_));
  std::error_code unknown;
  if (replaced_ && fs::exists(place_, unknown)) {
    SCANTROVE_TRY(replace());
  } else {
    SCANTROVE_TRY(rename());
  }
  path_.clear();
  return flushDiskOf(place_.parent_path());
}

Result<void> StagedFolder::rename() {
  // Removed before the rename: a finished folder never contains the marker, even after a crash.
  if (::unlink((path_ / kMarker).c_str()) != 0 && errno != ENOENT)
    return cannotMake(place_, systemReason(errno));
  if (::rename(path_.c_str(), place_.c_str()) == 0) return {};
  const int code = errno;
  if (code == ENOTEMPTY || code == EEXIST || code == ENOTDIR) {
    return fail("Something has been put into " + place_.string() + " while the export ran.",
                "Give another folder and export again.");
  }
  return cannotMake(place_, systemReason(code));
}

Result<void> StagedFolder::replace() {
  SCANTROVE_TRY(replaced_->checkUnchanged(place_));  // again: the export took a while
  // From here on the old folder has the marker of the staged one, whose name it gets: the next export removes
  // it if this program is killed. In the place the marker means nothing.
  if (!writeStagedMarker(place_, stagedMarkerOf(path_))) return cannotMake(place_, systemReason(errno));
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, place_.c_str(), RENAME_EXCHANGE) == 0) {
    removeOurMarker(place_);
    removeOld(path_);
    return {};
  }
  const int code = errno;
  removeOurMarker(place_);
  if (code != EINVAL && code != ENOSYS && code != ENOTSUP) return cannotMake(place_, systemReason(code));
  return replaceInSteps();
}

Result<void> StagedFolder::replaceInSteps() {
  const Result<fs::path> aside = makePartOf(place_);
  if (!aside) return fail(aside.error());
  std::error_code ignored;
  // While the place is empty, this marker makes the next export put the old folder back.
  const bool is_aside =
      writeStagedMarker(place_, replacedMarkerOf(*aside)) && ::rename(place_.c_str(), aside->c_str()) == 0;
  if (!is_aside) {
    const int code = errno;
    removeOurMarker(place_);
    fs::remove(*aside, ignored);
    return cannotMake(place_, systemReason(code));
  }
  if (auto renamed = rename(); !renamed) {
    fs::rename(*aside, place_, ignored);
    removeOurMarker(place_);
    return renamed;
  }
  removeOld(*aside);
  return {};
}

void StagedFolder::removeOld(const fs::path& folder) {
  if (replaced_->removeFrom(folder)) return;
  // What others put there in the last moment is theirs: without the marker it stays.
  removeOurMarker(folder);
  left_over_ = folder;
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
