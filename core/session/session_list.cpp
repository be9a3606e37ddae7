#include "core/session/session_list.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/database/database_connection.h"
#include "core/labeling/region_partition.h"
#include "core/session/inside_folder.h"
#include "core/session/recording_part.h"
#include "core/session/refinement_state.h"
#include "core/session/review_rows.h"
#include "core/session/session_schema.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Number of attempts: a writer that starts during a read makes the read inconsistent.
constexpr int kMaxTries = 3;

double megabytesIn(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code failure;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failure),
       end;
       !failure && entry != end; entry.increment(failure)) {
    std::error_code gone;
    if (!entry->is_regular_file(gone)) continue;
    const std::uintmax_t size = entry->file_size(gone);
    if (!gone) bytes += size;
  }
  return static_cast<double>(bytes) / 1e6;
}

/// The file as in /proc/locks, "08:01:5678": hexadecimal device and decimal inode. The device is that of
/// the mounted file system, which differs from stat's on btrfs. Empty: the file is missing.
std::string nameInLocks(const fs::path& file) {
  struct statx status {};
  if (::statx(AT_FDCWD, file.c_str(), 0, STATX_INO | STATX_MNT_ID, &status) != 0) return {};
  unsigned major_number = status.stx_dev_major, minor_number = status.stx_dev_minor;
  std::ifstream mounts("/proc/self/mountinfo");
  for (std::string line; std::getline(mounts, line);) {
    // "36 35 98:0 /mnt1 /mnt2 rw ..."
    std::istringstream words(line);
    std::uint64_t mount = 0, parent = 0;
    char colon = 0;
    unsigned mounted_major = 0, mounted_minor = 0;
    if (!(words >> mount >> parent >> mounted_major >> colon >> mounted_minor)) continue;
    if (mount != status.stx_mnt_id) continue;
    major_number = mounted_major;
    minor_number = mounted_minor;
  }
  std::ostringstream name;
  name << std::hex << std::setfill('0') << std::setw(2) << major_number << ':' << std::setw(2) << minor_number
       << ':' << std::dec << status.stx_ino;
  return name.str();
}

/// Whether any process has locked the file. Reads the kernel's list, because a trial lock would block
/// others.
bool isLocked(const fs::path& file) {
  const std::string requested = nameInLocks(file);
  if (requested.empty()) return false;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    // "1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF"
    std::istringstream words(line);
    std::string number, kind, way, access, process, place;
    words >> number >> kind >> way >> access >> process >> place;
    if (kind == "FLOCK" && place == requested) return true;
  }
  return false;
}

/// The first value of the query.
Result<QVariant> ask(DatabaseConnection& database, const QString& sql) {
  Result<QSqlQuery> answer = database.execute(sql);
  if (!answer) return fail(answer.error());
  return answer->next() ? answer->value(0) : QVariant();
}

Result<void> readCount(DatabaseConnection& database, const QString& sql, int& number) {
  const Result<QVariant> answer = ask(database, sql);
  if (!answer) return fail(answer.error());
  number = answer->toInt();
  return {};
}

Result<void> readText(DatabaseConnection& database, const QString& sql, std::string& text) {
  const Result<QVariant> answer = ask(database, sql);
  if (!answer) return fail(answer.error());
  text = answer->toString().toStdString();
  return {};
}

Result<void> readPicture(DatabaseConnection& database, SessionSummary& summary) {
  std::string file;
  SCANTROVE_TRY(readText(database,
                         "SELECT color_file FROM key_frames WHERE color_file <> '' ORDER BY number LIMIT 1"
                         " OFFSET (SELECT count(*) / 2 FROM key_frames WHERE color_file <> '')",
                         file));
  std::error_code ignored;
  if (isInsideFolder(summary.folder, file) && fs::is_regular_file(summary.folder / file, ignored))
    summary.picture = summary.folder / file;
  return {};
}

/// Replaces the names of regions by the catalogue's names of their objects at the last save (metadata
/// `objects`); deleted objects have none.
void readCurrentNames(const std::string& objects, std::map<std::uint32_t, std::string>& names) {
  const auto json = nlohmann::json::parse(objects, nullptr, false);
  if (!json.is_object()) return;
  for (auto& [region, name] : names) {
    const auto object = json.find(std::to_string(region));
    if (object == json.end() || !object->is_object()) continue;
    if (object->value("deleted", nlohmann::json()) == true) {
      name.clear();
    } else if (object->value("by_person", nlohmann::json()) == true) {
      const nlohmann::json called = object->value("name", nlohmann::json());
      if (called.is_string()) name = called.get<std::string>();
    }
  }
}

Result<void> readNames(DatabaseConnection& database, SessionSummary& summary) {
  Result<QSqlQuery> rows =
      database.execute("SELECT region, name FROM regions WHERE region IN (SELECT region FROM fragments)");
  if (!rows) return fail(rows.error());
  std::map<std::uint32_t, std::string> names;
  while (rows->next()) names[rows->value(0).toUInt()] = rows->value(1).toString().toStdString();
  std::string objects;
  SCANTROVE_TRY(readText(database, "SELECT value FROM facts WHERE name = 'objects'", objects));
  readCurrentNames(objects, names);
  std::set<std::string> distinct;
  for (const auto& [region, name] : names) distinct.insert(name);
  distinct.erase("");
  summary.names.assign(distinct.begin(), distinct.end());
  return {};
}

Result<void> readTables(DatabaseConnection& database, SessionSummary& summary) {
  const auto version = schema::versionToRead(database, schema::kSession, schema::sessionSteps(), 1);
  if (!version) return fail(version.error());
  SCANTROVE_TRY(readText(database, "SELECT value FROM facts WHERE name = 'source'", summary.source));
  SCANTROVE_TRY(readText(database,
                         QString("SELECT value FROM facts WHERE name = '%1'").arg(QLatin1String(kPartKey)),
                         summary.part));
  SCANTROVE_TRY(readText(database, "SELECT value FROM facts WHERE name = 'database'", summary.database));
  SCANTROVE_TRY(
      readText(database, "SELECT applied FROM schema_migrations WHERE version = 1", summary.started));
  int ended = 0;
  SCANTROVE_TRY(
      readCount(database, "SELECT count(*) FROM facts WHERE name = 'ended' AND value <> ''", ended));
  summary.ended = ended > 0;
  std::string refinement;
  SCANTROVE_TRY(readText(
      database, QString("SELECT value FROM facts WHERE name = '%1'").arg(QLatin1String(kRefinementKey)),
      refinement));
  summary.can_be_refined =
      canBeRefined({{kRefinementKey, refinement}, {"ended", summary.ended ? "yes" : ""}});
  std::string read_to_end;
  SCANTROVE_TRY(readText(
      database, QString("SELECT value FROM facts WHERE name = '%1'").arg(QLatin1String(kReadToEndKey)),
      read_to_end));
  summary.read_to_end = !read_to_end.empty();
  SCANTROVE_TRY(readCount(database, "SELECT count(*) FROM frames", summary.frames));
  SCANTROVE_TRY(readCount(database, "SELECT count(*) FROM frames WHERE state IN ('tracking', 'relocalised')",
                          summary.tracked));
  SCANTROVE_TRY(readCount(database, "SELECT count(*) FROM key_frames", summary.key_frames));
  SCANTROVE_TRY(readCount(database,
                          QString("SELECT count(*) FROM (SELECT region FROM fragments WHERE region > 0"
                                  " GROUP BY region HAVING sum(voxels) >= %1)")
                              .arg(kSmallFragmentVoxels),
                          summary.regions));
  SCANTROVE_TRY(readCount(database,
                          "SELECT count(DISTINCT object) FROM regions WHERE object > 0"
                          " AND region IN (SELECT region FROM fragments)",
                          summary.objects));
  SCANTROVE_TRY(moveInto(summary.reviews, rows::countReviews(database)));
  SCANTROVE_TRY(readNames(database, summary));
  return readPicture(database, summary);
}

/// Reads one consistent state.
Result<void> readSession(const fs::path& file, SessionSummary& summary) {
  for (int i = 1;; ++i) {
    const auto database = DatabaseConnection::openToRead(file.string());
    if (!database) return fail(database.error());
    Result<void> read = readTables(**database, summary);
    if ((*database)->isStill() || i == kMaxTries) return read;
  }
}

SessionSummary summaryOf(const fs::path& folder) {
  SessionSummary summary;
  summary.folder = folder;
  const fs::path place = fs::absolute(folder).lexically_normal();
  summary.name = (place.has_filename() ? place : place.parent_path()).filename().string();
  summary.megabytes = megabytesIn(folder);
  summary.in_use = isSessionInUse(folder);
  if (const Result<void> read = readSession(folder / "session.sqlite", summary); !read)
    summary.damage = read.error().message();
  return summary;
}

}  // namespace

std::vector<SessionSummary> listSessions(const fs::path& folder) {
  std::vector<SessionSummary> sessions;
  if (SessionStore::isSession(folder)) sessions.push_back(summaryOf(folder));
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (SessionStore::isSession(entry->path())) sessions.push_back(summaryOf(entry->path()));
  }
  std::ranges::sort(sessions, [](const SessionSummary& a, const SessionSummary& b) {
    return std::pair(b.started, a.name) < std::pair(a.started, b.name);
  });
  return sessions;
}

bool isSessionInUse(const fs::path& folder) { return isLocked(folder / "session.lock"); }

SessionMetadata readSessionMetadata(const fs::path& folder) {
  SessionMetadata metadata;
  if (!SessionStore::isSession(folder)) return metadata;
  const auto database = DatabaseConnection::openToRead((folder / "session.sqlite").string());
  if (!database || !schema::versionToRead(**database, schema::kSession, schema::sessionSteps(), 1))
    return metadata;
  Result<QSqlQuery> rows = (*database)->execute("SELECT name, value FROM facts");
  while (rows && rows->next())
    metadata[rows->value(0).toString().toStdString()] = rows->value(1).toString().toStdString();
  return metadata;
}

fs::path defaultScansFolder() {
  // According to the XDG Base Directory Specification, relative paths are ignored.
  const char* data = std::getenv("XDG_DATA_HOME");
  if (data != nullptr && fs::path(data).is_absolute()) return fs::path(data) / "scantrove" / "scans";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/") / ".local" / "share" / "scantrove" / "scans";
}

}  // namespace scantrove
