#include "core/session/map_files.h"

#include <cstdlib>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/database/transaction.h"
#include "core/session/checked_rows.h"
#include "core/session/own_files.h"
#include "core/session/row_checks.h"
#include "core/session/session_files.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Size from which on a new file of the map is started.
constexpr std::uint64_t kLargestFile_bytes = 256ULL << 20U;
/// Outdated records stay until they exceed this size and that of the current records.
constexpr std::uint64_t kOutdated_bytes = 32ULL << 20U;
/// Columns of `pages`: file, offset, packed and unpacked bytes. Page positions are 32-bit brick
/// coordinates.
constexpr rows::Bounds kPositions{-(1 << 27), 1 << 27}, kFiles{1, 1LL << 40}, kOffsets{0, 1LL << 40};
constexpr rows::Bounds kPacked_bytes{1, 1 << 30}, kUnpacked_bytes{4, (1 << 30) - 1};
constexpr std::string_view kFolder = "map/";

std::string nameOf(std::int64_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 6 ? 6 - digits.size() : 0, '0');
  return std::string(kFolder) + digits + ".bricks";
}

}  // namespace

fs::path MapFiles::pathOf(std::int64_t number) const { return folder_ / nameOf(number); }

Result<void> MapFiles::read(DatabaseConnection& database, std::vector<std::string>& damages) {
  Result<QSqlQuery> rows =
      database.execute("SELECT x, y, z, file, offset, bytes, unpacked_bytes, checksum, row_check FROM pages");
  if (!rows) return fail(rows.error());
  rows::RowAudit audit(*rows);
  int bad = 0;
  while (rows->next()) {
    const bool is_tracking_key_frame =
        audit.take(*rows) && rows::areIntegers(*rows, 0, 2, kPositions) &&
        rows::integerAt(*rows, 3, kFiles) && rows::integerAt(*rows, 4, kOffsets) &&
        rows::integerAt(*rows, 5, kPacked_bytes) && rows::integerAt(*rows, 6, kUnpacked_bytes);
    if (!is_tracking_key_frame) {
      ++bad;
      continue;
    }
    const auto number = [&](int column) { return rows->value(column).toLongLong(); };
    const Eigen::Vector3i position(rows->value(0).toInt(), rows->value(1).toInt(), rows->value(2).toInt());
    pages_[position] = {number(3), static_cast<std::uint64_t>(number(4)),
                        static_cast<std::uint32_t>(number(5)), static_cast<std::uint32_t>(number(6)),
                        static_cast<std::uint64_t>(number(7))};
    // A damaged row may name any file. Existing files stay open, so their pages remain readable even if
    // they are renamed.
    if (number(3) > last_number_ && fileToRead(number(3))) appended_ = last_number_ = number(3);
    static_cast<void>(fileToRead(number(3)));
  }
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " parts of the map of the session in " + database.file() +
                      " have no place in its files and are left out.");
  const Result<std::string> rest = audit.close(database, "pages", "parts of the map", *rows);
  if (!rest) return fail(rest.error());
  if (!rest->empty()) damages.push_back(*rest);
  return {};
}

void MapFiles::restart() {
  pages_.clear();
  added_.clear();
  unflushed_.clear();
  files_.clear();
  appended_.reset();
}

Result<RecordFile*> MapFiles::fileToRead(std::int64_t number) {
  const auto found = files_.find(number);
  if (found != files_.end()) return &found->second;
  std::error_code ignored;
  if (!fs::exists(pathOf(number), ignored)) {
    return fail("The file " + pathOf(number).string() + " is missing.",
                "Its part of the map is left out; restore the file from a copy if there is one.");
  }
  Result<RecordFile> opened = RecordFile::open(pathOf(number));
  if (!opened) return fail(opened.error());
  return &files_.emplace(number, std::move(*opened)).first->second;
}

Result<RecordFile*> MapFiles::fileToAppend(DatabaseConnection& database) {
  if (appended_) {
    Result<RecordFile*> last = fileToRead(*appended_);
    if (!last || (*last)->size() <= kLargestFile_bytes) return last;
  }
  for (;;) {
    const std::int64_t number = ++last_number_;
    const Result<bool> is_free = own_files::claim(database, folder_, nameOf(number));
    if (!is_free) return fail(is_free.error());
    if (!*is_free) continue;
    Result<RecordFile> made = RecordFile::create(pathOf(number));
    if (!made) return fail(made.error());
    appended_ = number;
    has_new_file_ = true;
    return &files_.insert_or_assign(number, std::move(*made)).first->second;
  }
}

Result<MapFiles::PageLocation> MapFiles::append(DatabaseConnection& database, const PackedWords& packed) {
  const Result<RecordFile*> to = fileToAppend(database);
  if (!to) return fail(to.error());
  const Result<std::uint64_t> offset = (*to)->append(packed);
  if (!offset) return fail(offset.error());
  unflushed_.insert(*appended_);
  return PageLocation{*appended_, *offset, static_cast<std::uint32_t>(packed.bytes.size()),
                      packed.unpacked_bytes, packed.checksum};
}

Result<void> MapFiles::add(DatabaseConnection& database, const SavedPage& page) {
  const Result<PageLocation> place = append(database, packWords(page.words));
  if (!place) return fail(place.error());
  added_[page.position] = *place;
  return {};
}

Result<void> MapFiles::flush() {
  while (!unflushed_.empty()) {
    const Result<RecordFile*> written = fileToRead(*unflushed_.begin());
    if (!written) return fail(written.error());
    SCANTROVE_TRY((*written)->flush());
    unflushed_.erase(unflushed_.begin());
  }
  if (has_new_file_) SCANTROVE_TRY(flushFolder(folder_ / kFolder));
  has_new_file_ = false;
  return {};
}

Result<void> MapFiles::writeLocations(DatabaseConnection& database) const {
  return writeLocations(database, added_);
}

Result<void> MapFiles::writeLocations(DatabaseConnection& database, const Pages& pages) const {
  std::set<std::string> names;
  for (const auto& [position, place] : pages) {
    names.insert(nameOf(place.file));
    SCANTROVE_TRY(rows::put(database, "pages",
                            {{"x", position.x()},
                             {"y", position.y()},
                             {"z", position.z()},
                             {"file", static_cast<qlonglong>(place.file)},
                             {"offset", static_cast<qlonglong>(place.offset)},
                             {"bytes", place.bytes},
                             {"unpacked_bytes", place.unpacked_bytes},
                             {"checksum", static_cast<qlonglong>(place.checksum)}}));
  }
  if (pages.empty()) return {};
  SCANTROVE_TRY(own_files::keep(database, std::vector<std::string>(names.begin(), names.end())));
  return rows::seal(database, "pages");
}

void MapFiles::commit() {
  for (const auto& [position, place] : std::exchange(added_, {})) pages_[position] = place;
}

std::vector<Eigen::Vector3i> MapFiles::positions() const {
  std::vector<Eigen::Vector3i> positions;
  for (const auto& [position, place] : pages_) positions.push_back(position);
  return positions;
}

Result<std::vector<std::uint32_t>> MapFiles::load(const Eigen::Vector3i& position) {
  const auto found = pages_.find(position);
  if (found == pages_.end())
    return fail("A part of the map of " + folder_.string() + " has no place in its files.",
                "It is left out.");
  const PageLocation& place = found->second;
  const Result<RecordFile*> from = fileToRead(place.file);
  if (!from) return fail(from.error());
  Result<std::vector<char>> bytes = (*from)->read(place.offset, place.bytes);
  if (!bytes) return fail(bytes.error());
  auto words = unpackWords({std::move(*bytes), place.unpacked_bytes, place.checksum});
  if (!words) {
    return fail("A part of the map in " + pathOf(place.file).string() + " is damaged.",
                "That part is left out; the rest can be used. Restore the file from a copy if there is one.");
  }
  return std::move(*words);
}

std::uint64_t MapFiles::liveBytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [position, place] : pages_) bytes += place.bytes;
  return bytes;
}

Result<std::set<std::int64_t>> MapFiles::ownNumbers(DatabaseConnection& database) const {
  const Result<std::vector<std::string>> names = own_files::kept(database);
  if (!names) return fail(names.error());
  std::set<std::int64_t> numbers;
  for (const std::string& name : *names) {
    if (!name.starts_with(kFolder)) continue;
    const std::int64_t number = std::strtoll(name.c_str() + kFolder.size(), nullptr, 10);
    if (number >= kFiles.least && name == nameOf(number)) numbers.insert(number);
  }
  return numbers;
}

Result<void> MapFiles::compact(DatabaseConnection& database) {
  const Result<std::set<std::int64_t>> old = ownNumbers(database);
  if (!old) return fail(old.error());
  std::uint64_t all_bytes = 0;
  for (const std::int64_t number : *old) {
    std::error_code missing;
    const std::uintmax_t bytes = fs::file_size(pathOf(number), missing);
    if (!missing) all_bytes += bytes;
  }
  const std::uint64_t live_bytes = liveBytes();
  if (all_bytes < live_bytes + std::max(kOutdated_bytes, live_bytes)) return {};

  SCANTROVE_TRY(movePages(database, *old));
  std::set<std::int64_t> used;
  for (const auto& [position, place] : pages_) used.insert(place.file);
  for (const std::int64_t number : *old) {
    if (!used.contains(number)) files_.erase(number);
  }
  return own_files::removeUnused(database, folder_, own_files::Which::outdated);
}

Result<MapFiles::Pages> MapFiles::copyPages(DatabaseConnection& database, const Pages& pages) {
  Pages copied;
  for (const auto& [position, place] : pages) {
    const Result<RecordFile*> from = fileToRead(place.file);
    if (!from) continue;
    Result<std::vector<char>> bytes = (*from)->read(place.offset, place.bytes);
    if (!bytes) continue;  // its position stays, and reports the damage
    const Result<PageLocation> to =
        append(database, {std::move(*bytes), place.unpacked_bytes, place.checksum});
    if (!to) return fail(to.error());
    copied[position] = *to;
  }
  SCANTROVE_TRY(flush());
  return copied;
}

Result<void> MapFiles::movePages(DatabaseConnection& database, const std::set<std::int64_t>& old) {
  appended_.reset();
  const Result<Pages> moved = copyPages(database, pages_);
  if (!moved) return fail(moved.error());
  std::set<std::int64_t> unused = old;
  for (const auto& [position, place] : pages_) {
    if (!moved->contains(position)) unused.erase(place.file);
  }
  std::vector<std::string> names;
  for (const std::int64_t number : unused) names.push_back(nameOf(number));
  const auto write = [&]() -> Result<void> {
    SCANTROVE_TRY(writeLocations(database, *moved));
    return own_files::outdate(database, names);
  };
  SCANTROVE_TRY(inTransaction(database, write));
  for (const auto& [position, place] : *moved) pages_[position] = place;
  return {};
}

bool MapFiles::areStillThere() const {
  return std::ranges::all_of(files_, [](const auto& file) { return file.second.isStillThere(); });
}

Result<void> MapFiles::writeLostAnew(DatabaseConnection& database) {
  std::set<std::int64_t> lost;
  for (const auto& [number, file] : files_) {
    if (!file.isStillThere()) lost.insert(number);
  }
  if (lost.empty()) return {};
  if (appended_ && lost.contains(*appended_)) appended_.reset();
  const auto of = [&](const Pages& pages) {
    Pages of_lost;
    std::ranges::copy_if(pages, std::inserter(of_lost, of_lost.end()),
                         [&](const auto& page) { return lost.contains(page.second.file); });
    return of_lost;
  };
  const Result<Pages> pages = copyPages(database, of(pages_));
  if (!pages) return fail(pages.error());
  const Result<Pages> added = copyPages(database, of(added_));
  if (!added) return fail(added.error());
  const auto write = [&]() -> Result<void> {
    SCANTROVE_TRY(writeLocations(database, *pages));
    // Another file may have the name by now, which must not be removed.
    for (const std::int64_t number : lost) SCANTROVE_TRY(own_files::disown(database, nameOf(number)));
    return {};
  };
  SCANTROVE_TRY(inTransaction(database, write));
  for (const auto& [position, place] : *pages) pages_[position] = place;
  for (const auto& [position, place] : *added) added_[position] = place;
  for (const std::int64_t number : lost) {
    files_.erase(number);
    unflushed_.erase(number);
  }
  return {};
}

void MapFiles::moveTo(const fs::path& folder) {
  folder_ = folder;
  files_.clear();
}

}  // namespace scantrove
