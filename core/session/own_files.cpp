#include "core/session/own_files.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "core/session/checked_rows.h"
#include "core/session/inside_folder.h"

namespace scantrove::own_files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTable = "files";
constexpr const char* kNew = "new";
constexpr const char* kStored = "kept";
constexpr const char* kOld = "old";
constexpr std::size_t kMinDigits = 6;
constexpr std::string_view kDigits = "0123456789";

Result<void> enter(DatabaseConnection& database, const std::string& name, const char* state) {
  return rows::put(database, kTable, {{"name", QString::fromStdString(name)}, {"state", state}});
}

Result<void> enterAll(DatabaseConnection& database, std::span<const std::string> names, const char* state) {
  for (const std::string& name : names) SCANTROVE_TRY(enter(database, name, state));
  return {};
}

/// Entries with a matching checksum. Rows from earlier versions have none, and name stored files.
Result<std::vector<std::string>> namesIn(DatabaseConnection& database, const char* state) {
  Result<QSqlQuery> rows =
      database.execute("SELECT name, state, row_check FROM files WHERE state = ? ORDER BY name", {state});
  if (!rows) return fail(rows.error());
  rows::RowAudit audit(*rows);
  std::vector<std::string> names;
  const bool needs_check = std::string_view(state) != kStored;
  while (rows->next()) {
    if (audit.take(*rows) && !(needs_check && rows->value(2).isNull()))
      names.push_back(rows->value(0).toString().toStdString());
  }
  return names;
}

/// `000123` or `000123-2`, then one of `endings`.
template <std::size_t N>
bool isNumbered(std::string_view name, const std::array<std::string_view, N>& endings) {
  const std::size_t digits = std::min(name.find_first_not_of(kDigits), name.size());
  if (digits < kMinDigits) return false;
  name.remove_prefix(digits);
  if (name.starts_with('-')) {
    name.remove_prefix(1);
    const std::size_t more = std::min(name.find_first_not_of(kDigits), name.size());
    if (more == 0) return false;
    name.remove_prefix(more);
  }
  return std::ranges::find(endings, name) != endings.end();
}

/// False: a reader of the database delays writing the last commit to disk, so a power cut may undo it.
Result<bool> isOnDisk(DatabaseConnection& database) {
  Result<QSqlQuery> checkpoint = database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (!checkpoint) return fail(checkpoint.error());
  return checkpoint->next() && checkpoint->value(0).toInt() == 0;
}

Result<void> removeAll(DatabaseConnection& database, const fs::path& folder, const char* state) {
  const Result<std::vector<std::string>> names = namesIn(database, state);
  if (!names) return fail(names.error());
  if (names->empty()) return {};
  const Result<bool> is_on_disk = isOnDisk(database);
  if (!is_on_disk) return fail(is_on_disk.error());
  if (!*is_on_disk) return {};  // try again later
  for (const std::string& name : *names) {
    std::error_code failure;
    if (hasFormOfOurs(name) && isInsideFolder(folder, name)) fs::remove(folder / name, failure);
    if (!failure) SCANTROVE_TRY(disown(database, name));
  }
  return {};
}

}  // namespace

bool hasFormOfOurs(const fs::path& name) {
  const std::string file = name.filename().string();
  if (name.parent_path() == "map") return isNumbered(file, std::array<std::string_view, 1>{".bricks"});
  return name.parent_path() == "keyframes" &&
         isNumbered(file,
                    std::array<std::string_view, 4>{".depth.png", ".color.png", ".color.jpg", ".color.jpeg"});
}

Result<bool> claim(DatabaseConnection& database, const fs::path& folder, const std::string& name) {
  std::error_code failure;
  const fs::file_type type = fs::symlink_status(folder / name, failure).type();
  if (type == fs::file_type::none) {
    return fail("The folder " + folder.string() + " cannot be read: " + failure.message() + ".",
                "Check its permissions.");
  }
  if (type != fs::file_type::not_found) return false;
  SCANTROVE_TRY(enter(database, name, kNew));
  return true;
}

Result<void> keep(DatabaseConnection& database, std::span<const std::string> names) {
  return enterAll(database, names, kStored);
}

Result<void> outdate(DatabaseConnection& database, std::span<const std::string> names) {
  return enterAll(database, names, kOld);
}

Result<void> disown(DatabaseConnection& database, const std::string& name) {
  SCANTROVE_TRY(database.execute("DELETE FROM files WHERE name = ?", {QString::fromStdString(name)}));
  return {};
}

Result<std::vector<std::string>> kept(DatabaseConnection& database) { return namesIn(database, kStored); }

Result<void> removeUnused(DatabaseConnection& database, const fs::path& folder, Which which) {
  SCANTROVE_TRY(removeAll(database, folder, kOld));
  return which == Which::outdated ? Result<void>() : removeAll(database, folder, kNew);
}

}  // namespace scantrove::own_files
