#include "core/session/session_store.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/database/transaction.h"
#include "core/session/checked_rows.h"
#include "core/session/inside_folder.h"
#include "core/session/own_files.h"
#include "core/session/replaced_session.h"
#include "core/session/session_files.h"
#include "core/session/session_rows.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatabase = "session.sqlite";
constexpr const char* kLock = "session.lock";
/// Maximum number of names tried for one image.
constexpr int kMaxImageNames = 1000;

Result<FileLock> lockOf(const fs::path& folder) {
  return FileLock::take(folder / kLock, {"The session " + folder.string() + " is in use by another program.",
                                         "Wait until that is done, or use a copy of the folder."});
}

bool hasPose(const SavedDelta& delta) { return std::ranges::any_of(delta.frames, &SavedFrame::isUsable); }

}  // namespace

SessionStore::~SessionStore() = default;

bool SessionStore::isSession(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kDatabase, ignored);
}

Result<std::unique_ptr<SessionStore>> SessionStore::create(const fs::path& folder) {
  const bool has_session = isSession(folder);
  if (!has_session) SCANTROVE_TRY(makeSessionFolders(folder));
  Result<std::unique_ptr<SessionStore>> store = openLocked(folder);
  if (store && has_session) SCANTROVE_TRY((*store)->beginReplacing());
  return store;
}

Result<std::unique_ptr<SessionStore>> SessionStore::open(const fs::path& folder) {
  if (!isSession(folder)) {
    return fail("There is no session in " + folder.string() + " (no session.sqlite).",
                "Give the folder that a scan was written to (scan --out).");
  }
  return openLocked(folder);
}

Result<std::unique_ptr<SessionStore>> SessionStore::openLocked(const fs::path& folder) {
  SCANTROVE_TRY(checkHasNoLinks(folder));
  Result<FileLock> lock = lockOf(folder);
  if (!lock) return fail(lock.error());
  std::unique_ptr<SessionStore> store(new SessionStore(folder, std::move(*lock)));
  store->lock_file_ = HeldFile::hold(folder / kLock);
  SCANTROVE_TRY(moveInto(store->database_, SessionDatabase::open(folder / kDatabase)));
  SCANTROVE_TRY(makeSessionFolders(folder));
  DatabaseConnection& database = **store->database_;
  SCANTROVE_TRY(own_files::removeUnused(database, folder, own_files::Which::outdated_and_new));
  SCANTROVE_TRY(store->map_.read(database, store->damages_));
  SCANTROVE_TRY(moveInto(store->lost_before_, store->countLostImages()));
  return store;
}

Result<void> SessionStore::beginReplacing() {
  SCANTROVE_TRY(checkIsUnlabeled(**database_, folder_));
  replaces_ = true;
  map_.restart();
  lost_before_ = 0;
  damages_.clear();
  return {};
}

bool SessionStore::waitsWith(const SavedDelta& delta) {
  if (!replaces_ || hasPose(delta)) return false;
  waiting_.push_back(delta);
  return true;
}

Result<void> SessionStore::writePages(std::span<const SavedPage> pages) {
  for (const SavedPage& page : pages) SCANTROVE_TRY(map_.add(**database_, page));
  return {};
}

Result<void> SessionStore::save(const SavedDelta& delta) {
  if (waitsWith(delta)) return {};
  SCANTROVE_TRY(map_.flush());
  SCANTROVE_TRY(write(delta, true));
  map_.commit();
  return map_.compact(**database_);
}

Result<void> SessionStore::saveKeyFrame(const SavedFrame& frame, const SavedKeyFrame& images) {
  SavedDelta delta;
  delta.frames.push_back(frame);
  delta.key_frames.push_back(images);
  if (waitsWith(delta)) return {};
  return write(delta, false);
}

Result<void> SessionStore::deleteMapRows() {
  DatabaseConnection& database = **database_;
  for (const char* table :
       {"key_frames", "fragments", "regions", "borders", "estimates", "objectness", "pages", "camera"}) {
    SCANTROVE_TRY(database.execute(QString("DELETE FROM ") + table));
    SCANTROVE_TRY(rows::seal(database, table));
  }
  const Result<std::vector<std::string>> files = own_files::kept(database);
  if (!files) return fail(files.error());
  return own_files::outdate(database, *files);
}

Result<void> SessionStore::forgetMap() {
  map_.restart();
  if (replaces_) return {};
  SCANTROVE_TRY(inTransaction(**database_, [&] { return deleteMapRows(); }));
  lost_before_ = 0;
  return own_files::removeUnused(**database_, folder_, own_files::Which::outdated);
}

Result<void> SessionStore::write(const SavedDelta& delta, bool with_pages) {
  DatabaseConnection& database = **database_;
  if (!replaces_) return inTransaction(database, [&] { return writeRows(delta, with_pages); });
  // The new session is synced to disk before the old one's files are removed.
  for (const SavedKeyFrame& key : delta.key_frames) {
    SCANTROVE_TRY(flushFile(folder_ / key.depth_file));
    if (!key.color_file.empty()) SCANTROVE_TRY(flushFile(folder_ / key.color_file));
  }
  SCANTROVE_TRY(flushFolder(folder_ / "keyframes"));
  const auto replace = [&]() -> Result<void> {
    SCANTROVE_TRY(clearSession(database));
    for (const SavedDelta& before : waiting_) SCANTROVE_TRY(writeRows(before, false));
    return writeRows(delta, with_pages);
  };
  SCANTROVE_TRY(inTransaction(database, replace));
  replaces_ = false;
  waiting_.clear();
  return own_files::removeUnused(database, folder_, own_files::Which::outdated);
}

Result<void> SessionStore::writeRows(const SavedDelta& delta, bool with_pages) {
  DatabaseConnection& database = **database_;
  SCANTROVE_TRY(rows::write(database, delta));
  std::vector<std::string> images;
  for (const SavedKeyFrame& key : delta.key_frames) {
    images.push_back(key.depth_file.generic_string());
    if (!key.color_file.empty()) images.push_back(key.color_file.generic_string());
  }
  SCANTROVE_TRY(own_files::keep(database, images));
  return with_pages ? map_.writeLocations(database) : Result<void>();
}

Result<fs::path> SessionStore::claimImage(const std::string& stem, const std::string& ending) {
  for (int i = 1; i <= kMaxImageNames; ++i) {
    const std::string name = "keyframes/" + stem + (i > 1 ? "-" + std::to_string(i) : "") + ending;
    const Result<bool> is_free = own_files::claim(**database_, folder_, name);
    if (!is_free) return fail(is_free.error());
    if (*is_free) return fs::path(name);
  }
  return fail(
      "In " + (folder_ / "keyframes").string() + " there is no free name for an image " + stem + ending + ".",
      "Move files of other programs away.");
}

Result<SavedScan> SessionStore::load() {
  if (replaces_) return SavedScan{};
  Result<SavedScan> scan = rows::read(**database_, damages_);
  if (!scan) return scan;
  const auto outside = std::erase_if(scan->key_frames, [&](const SavedKeyFrame& key) {
    return !isInsideFolder(folder_, key.depth_file) ||
           (!key.color_file.empty() && !isInsideFolder(folder_, key.color_file));
  });
  if (outside > 0)
    damages_.push_back(std::to_string(outside) + " key frames name images outside of " + folder_.string() +
                       " and are left out.");
  scan->pages = map_.positions();
  return scan;
}

Result<std::vector<std::uint32_t>> SessionStore::loadPage(const Eigen::Vector3i& position) {
  return map_.load(position);
}

Result<std::optional<SavedCamera>> SessionStore::loadCamera() {
  if (replaces_) return std::optional<SavedCamera>();
  return rows::readCamera(**database_);
}

bool SessionStore::isLocked() const { return lock_file_ && lock_file_->place() == HeldFile::Place::same; }

Result<void> SessionStore::takeLock() {
  SCANTROVE_TRY(moveInto(lock_, lockOf(folder_)));
  lock_file_ = HeldFile::hold(folder_ / kLock);
  return {};
}

Result<std::optional<Error>> SessionStore::keepInPlace() {
  if (!database_->isOpen())
    return fail(
        "The session in " + folder_.string() + " could not be opened again after other programs changed it.",
        "Open it anew.");
  if (database_->isStillThere() && map_.areStillThere()) {
    if (!isLocked()) SCANTROVE_TRY(takeLock());
    return std::optional<Error>();
  }
  const fs::path moved_to = database_->folderItWasMovedWith();
  if (!moved_to.empty()) {
    const std::string before = folder_.string();
    folder_ = moved_to;
    map_.moveTo(folder_);
    SCANTROVE_TRY(database_->moveTo(folder_));
    lock_file_ = HeldFile::hold(folder_ / kLock);
    return std::optional<Error>({"The session " + before + " was moved to " + folder_.string() +
                                     " while it was in use; it is kept there.",
                                 "Move no folder that a program works in."});
  }
  Result<Error> lost = writeAnew();
  if (!lost) return fail(lost.error());
  return std::optional<Error>(std::move(*lost));
}

Result<Error> SessionStore::writeAnew() {
  const std::string gone = "Files of the session in " + folder_.string() +
                           " were removed or replaced by another program while it was in use";
  const auto cannot = [&](const Error& error) {
    return fail(gone + ", and cannot be written anew. " + error.what, error.advice);
  };
  Result<void> made = makeSessionFolders(folder_);
  if (made && !isLocked()) made = takeLock();
  if (made && !database_->isStillThere()) made = database_->writeAnew();
  if (made) made = map_.writeLostAnew(**database_);
  if (!made) return cannot(made.error());
  const bool is_elsewhere = database_->file() != folder_ / kDatabase;
  return Error{
      gone + (is_elsewhere ? "; it is kept in " + database_->file().string() + "."
                           : "; they were written anew."),
      is_elsewhere ? "Move the other file away and name this one " + std::string(kDatabase) + "." : ""};
}

Result<int> SessionStore::countLostImages() const {
  Result<QSqlQuery> names = (*database_)->execute("SELECT color_file, depth_file FROM key_frames");
  if (!names) return fail(names.error());
  int lost = 0;
  while (names->next()) {
    for (const int column : {0, 1}) {
      const std::string name = names->value(column).toString().toStdString();
      std::error_code ignored;
      lost += !name.empty() && !fs::is_regular_file(folder_ / name, ignored) ? 1 : 0;
    }
  }
  return lost;
}

Result<std::optional<Error>> SessionStore::findLostImages() {
  if (replaces_) return std::optional<Error>();
  const Result<int> lost = countLostImages();
  if (!lost) return fail(lost.error());
  if (*lost <= lost_before_) return std::optional<Error>();
  return std::optional<Error>({std::to_string(*lost - lost_before_) + " images of key frames in " +
                                   folder_.string() + " were removed by another program while it was in use.",
                               "Restore them from a copy if there is one; the rest can be used."});
}

}  // namespace scantrove
