#include "core/session/session_store.h"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>
#include <utility>

#include "core/database/transaction.h"
#include "core/session/inside_folder.h"
#include "core/session/row_checks.h"
#include "core/session/session_files.h"
#include "core/session/session_rows.h"
#include "core/session/session_schema.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDatabase = "session.sqlite";
/// A file of the map is followed by a new one from this size on.
constexpr std::uint64_t kLargestFile_bytes = 256ULL << 20U;
/// Outdated records are left alone up to this much, and up to as much as there is that is not.
constexpr std::uint64_t kOutdated_bytes = 32ULL << 20U;
/// Of `pages`: file, offset, packed and unpacked bytes. A page lies within 32-bit brick coordinates.
constexpr rows::Bounds kPositions{-(1 << 27), 1 << 27}, kFiles{1, 1LL << 40}, kOffsets{0, 1LL << 40};
constexpr rows::Bounds kPacked_bytes{1, 1 << 30}, kUnpacked_bytes{4, (1 << 30) - 1};

Result<void> makeFolders(const fs::path& folder) {
  std::error_code failure;
  for (const fs::path& path : {folder, folder / "map", folder / "keyframes"}) {
    fs::create_directories(path, failure);
    if (failure) {
      return fail("The folder " + path.string() + " cannot be made: " + failure.message() + ".",
                  "Check the name and the permissions of the folder above.");
    }
  }
  return {};
}

}  // namespace

SessionStore::~SessionStore() = default;

bool SessionStore::isSession(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kDatabase, ignored);
}

Result<void> SessionStore::checkReplaceable(const fs::path& folder) {
  const Result<std::unique_ptr<SessionStore>> store = openLocked(folder);
  if (!store) return fail(store.error());
  Result<QSqlQuery> count = (*store)->database_->execute("SELECT count(*) FROM operations");
  if (!count) return fail(count.error());
  if (count->next() && count->value(0).toInt() > 0) {
    return fail("In " + folder.string() + " there is a scan that somebody has labelled.",
                "Go on in it with --resume, or name another folder.");
  }
  return {};
}

Result<std::unique_ptr<SessionStore>> SessionStore::create(const fs::path& folder) {
  if (isSession(folder)) {
    SCANTROVE_TRY(checkReplaceable(folder));
    SCANTROVE_TRY(removeSessionFiles(folder));
  }
  SCANTROVE_TRY(makeFolders(folder));
  return openLocked(folder);
}

Result<std::unique_ptr<SessionStore>> SessionStore::open(const fs::path& folder) {
  if (!isSession(folder)) {
    return fail("There is no session in " + folder.string() + " (no session.sqlite).",
                "Give the folder that a scan was written to (scan --out).");
  }
  return openLocked(folder);
}

Result<std::unique_ptr<SessionStore>> SessionStore::openLocked(const fs::path& folder) {
  Result<FileLock> lock = FileLock::take(folder / "session.lock",
                                         {"The session " + folder.string() + " is in use by another program.",
                                          "Wait until that is done, or use a copy of the folder."});
  if (!lock) return fail(lock.error());
  std::unique_ptr<SessionStore> store(new SessionStore(folder, std::move(*lock)));
  SCANTROVE_TRY(moveInto(store->database_, DatabaseConnection::open((folder / kDatabase).string())));
  SCANTROVE_TRY(schema::migrate(*store->database_, schema::kSession, schema::sessionSteps()));
  SCANTROVE_TRY(makeFolders(folder));
  SCANTROVE_TRY(store->readPlaces());
  return store;
}

fs::path SessionStore::fileName(std::int64_t number) const {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return folder_ / "map" / (digits + ".bricks");
}

Result<RecordFile*> SessionStore::file(std::int64_t number) {
  auto found = files_.find(number);
  if (found == files_.end()) {
    Result<RecordFile> opened = RecordFile::open(fileName(number));
    if (!opened) return fail(opened.error());
    found = files_.emplace(number, std::move(*opened)).first;
  }
  return &found->second;
}

Result<RecordFile*> SessionStore::fileToRead(std::int64_t number) {
  std::error_code ignored;
  if (files_.contains(number) || fs::exists(fileName(number), ignored)) return file(number);
  return fail("The file " + fileName(number).string() + " is missing.",
              "Its part of the map is left out; restore the file from a copy if there is one.");
}

Result<void> SessionStore::readPlaces() {
  Result<QSqlQuery> rows =
      database_->execute("SELECT x, y, z, file, offset, bytes, unpacked_bytes, checksum FROM pages");
  if (!rows) return fail(rows.error());
  int bad = 0;
  while (rows->next()) {
    const bool is_place = rows::areIntegers(*rows, 0, 2, kPositions) && rows::integerAt(*rows, 3, kFiles) &&
                          rows::integerAt(*rows, 4, kOffsets) && rows::integerAt(*rows, 5, kPacked_bytes) &&
                          rows::integerAt(*rows, 6, kUnpacked_bytes);
    if (!is_place) {
      ++bad;
      continue;
    }
    const auto number = [&](int column) { return rows->value(column).toLongLong(); };
    const Eigen::Vector3i position(rows->value(0).toInt(), rows->value(1).toInt(), rows->value(2).toInt());
    pages_[position] = {number(3), static_cast<std::uint64_t>(number(4)),
                        static_cast<std::uint32_t>(number(5)), static_cast<std::uint32_t>(number(6)),
                        static_cast<std::uint64_t>(number(7))};
    // A damaged row may name any file.
    std::error_code ignored;
    if (number(3) > current_ && fs::exists(fileName(number(3)), ignored)) current_ = number(3);
  }
  if (bad > 0)
    damages_.push_back(std::to_string(bad) + " parts of the map of the session in " + database_->file() +
                       " have no place in its files and are left out.");
  return {};
}

Result<SessionStore::PagePlace> SessionStore::append(const PackedWords& packed) {
  Result<RecordFile*> to = file(current_);
  if (to && (*to)->size() > kLargestFile_bytes) to = file(++current_);
  if (!to) return fail(to.error());
  const Result<std::uint64_t> offset = (*to)->append(packed);
  if (!offset) return fail(offset.error());
  return PagePlace{current_, *offset, static_cast<std::uint32_t>(packed.bytes.size()), packed.unpacked_bytes,
                   packed.checksum};
}

Result<void> SessionStore::writePages(std::span<const SavedPage> pages) {
  for (const SavedPage& page : pages) {
    const Result<PagePlace> place = append(packWords(page.words));
    if (!place) return fail(place.error());
    written_[page.position] = *place;
  }
  return {};
}

Result<void> SessionStore::save(const SavedDelta& delta) {
  SCANTROVE_TRY(inTransaction(*database_, [&] { return writeRows(delta); }));
  for (const auto& [position, place] : std::exchange(written_, {})) pages_[position] = place;
  return compact();
}

Result<void> SessionStore::writeRows(const SavedDelta& delta) {
  SCANTROVE_TRY(rows::write(*database_, delta));
  return writePlaces(written_);
}

Result<void> SessionStore::saveKeyFrame(const SavedFrame& frame, const SavedKeyFrame& images) {
  SavedDelta delta;
  delta.frames.push_back(frame);
  delta.key_frames.push_back(images);
  return inTransaction(*database_, [&] { return rows::write(*database_, delta); });
}

Result<void> SessionStore::writePlaces(const Pages& pages) {
  for (const auto& [position, place] : pages) {
    SCANTROVE_TRY(
        database_->execute("INSERT OR REPLACE INTO pages VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                           {position.x(), position.y(), position.z(), static_cast<qlonglong>(place.file),
                            static_cast<qlonglong>(place.offset), place.bytes, place.unpacked_bytes,
                            static_cast<qlonglong>(place.checksum)}));
  }
  return {};
}

Result<SavedScan> SessionStore::load() {
  Result<SavedScan> scan = rows::read(*database_, damages_);
  if (!scan) return scan;
  const auto outside = std::erase_if(scan->key_frames, [&](const SavedKeyFrame& key) {
    return !isInsideFolder(folder_, key.depth_file) ||
           (!key.color_file.empty() && !isInsideFolder(folder_, key.color_file));
  });
  if (outside > 0)
    damages_.push_back(std::to_string(outside) + " key frames name images outside of " + folder_.string() +
                       " and are left out.");
  for (const auto& [position, place] : pages_) scan->pages.push_back(position);
  return scan;
}

Result<std::vector<std::uint32_t>> SessionStore::loadPage(const Eigen::Vector3i& position) {
  const PagePlace& place = pages_.at(position);
  const Result<RecordFile*> from = fileToRead(place.file);
  if (!from) return fail(from.error());
  Result<std::vector<char>> bytes = (*from)->read(place.offset, place.bytes);
  if (!bytes) return fail(bytes.error());
  auto words = unpackWords({std::move(*bytes), place.unpacked_bytes, place.checksum});
  if (!words) {
    return fail("A part of the map in " + fileName(place.file).string() + " is damaged.",
                "That part is left out; the rest can be used. Restore the file from a copy if there is one.");
  }
  return std::move(*words);
}

Result<std::optional<SavedCamera>> SessionStore::loadCamera() { return rows::readCamera(*database_); }

std::uint64_t SessionStore::liveBytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [position, place] : pages_) bytes += place.bytes;
  return bytes;
}

std::vector<std::int64_t> SessionStore::fileNumbers() const {
  std::vector<std::int64_t> numbers;
  std::error_code failure;
  for (fs::directory_iterator entry(folder_ / "map", failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::int64_t number = std::strtoll(entry->path().filename().c_str(), nullptr, 10);
    if (number >= kFiles.least && entry->path() == fileName(number)) numbers.push_back(number);
  }
  return numbers;
}

Result<void> SessionStore::compact() {
  const std::vector<std::int64_t> old = fileNumbers();
  std::uint64_t all_bytes = 0;
  for (const std::int64_t number : old) {
    std::error_code missing;
    const std::uintmax_t bytes = fs::file_size(fileName(number), missing);
    if (!missing) all_bytes += bytes;
  }
  const std::uint64_t live_bytes = liveBytes();
  if (all_bytes < live_bytes + std::max(kOutdated_bytes, live_bytes)) return {};

  const Result<bool> is_on_disk = movePages();
  if (!is_on_disk) return fail(is_on_disk.error());
  if (!*is_on_disk) return {};  // the old files go with the next compaction
  std::set<fs::path> used{fileName(current_)};
  for (const auto& [position, place] : pages_) used.insert(fileName(place.file));
  for (const std::int64_t number : old) {
    if (used.contains(fileName(number))) continue;
    files_.erase(number);
    std::error_code ignored;
    fs::remove(fileName(number), ignored);
  }
  return {};
}

Result<bool> SessionStore::movePages() {
  const std::int64_t first_new = ++current_;
  Pages moved;
  for (const auto& [position, place] : pages_) {
    const Result<RecordFile*> from = fileToRead(place.file);
    if (!from) continue;
    Result<std::vector<char>> bytes = (*from)->read(place.offset, place.bytes);
    if (!bytes) continue;  // its place stays, and says that it is damaged
    const Result<PagePlace> to = append({std::move(*bytes), place.unpacked_bytes, place.checksum});
    if (!to) return fail(to.error());
    moved[position] = *to;
  }
  for (std::int64_t number = first_new; number <= current_; ++number) {
    const Result<RecordFile*> written = file(number);
    if (!written) return fail(written.error());
    SCANTROVE_TRY((*written)->flush());
  }
  SCANTROVE_TRY(flushFolder(folder_ / "map"));
  SCANTROVE_TRY(inTransaction(*database_, [&] { return writePlaces(moved); }));
  for (const auto& [position, place] : moved) pages_[position] = place;
  // A transaction alone may be lost in a power cut, and then the old places count again.
  Result<QSqlQuery> checkpoint = database_->execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (!checkpoint) return fail(checkpoint.error());
  return checkpoint->next() && checkpoint->value(0).toInt() == 0;
}

}  // namespace scantrove
