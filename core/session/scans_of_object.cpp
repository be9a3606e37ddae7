#include "core/session/scans_of_object.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "core/database/database_connection.h"
#include "core/session/catalogue_numbers.h"
#include "core/session/session_schema.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

constexpr int kReadingTries = 3;  ///< a writer that starts during a reading makes it inconsistent

Result<QVariant> firstOf(DatabaseConnection& database, const QString& sql) {
  Result<QSqlQuery> answer = database.execute(sql);
  if (!answer) return fail(answer.error());
  return answer->next() ? answer->value(0) : QVariant();
}

Result<QVariant> metadataIn(DatabaseConnection& database, const char* name) {
  return firstOf(database,
                 QStringLiteral("SELECT value FROM facts WHERE name = '%1'").arg(QLatin1String(name)));
}

/// Number of regions of the map that are one of these objects.
Result<int> countRegions(DatabaseConnection& database, const std::set<ObjectId>& objects) {
  Result<QSqlQuery> rows = database.execute(
      QStringLiteral("SELECT object FROM regions WHERE object > 0 AND region IN (SELECT region FROM "
                     "fragments)"));
  if (!rows) return fail(rows.error());
  int regions = 0;
  while (rows->next()) regions += objects.contains(ObjectId{rows->value(0).toUInt()}) ? 1 : 0;
  return regions;
}

/// None: another catalogue, or without the object.
Result<std::optional<ScanOfObject>> readScan(DatabaseConnection& database, const std::string& catalogue,
                                             const std::set<ObjectId>& objects) {
  const auto version = schema::versionToRead(database, schema::kSession, schema::sessionSteps(), 1);
  if (!version) return fail(version.error());
  const Result<QVariant> of_catalogue = metadataIn(database, kCatalogueKey);
  if (!of_catalogue) return fail(of_catalogue.error());
  if (of_catalogue->toString().toStdString() != catalogue) return std::optional<ScanOfObject>();
  ScanOfObject scan;
  SCANTROVE_TRY(moveInto(scan.regions, countRegions(database, objects)));
  if (scan.regions == 0) return std::optional<ScanOfObject>();
  const Result<QVariant> source = metadataIn(database, "source");
  const Result<QVariant> started =
      firstOf(database, QStringLiteral("SELECT applied FROM schema_migrations WHERE version = 1"));
  const Result<QVariant> key_frames = firstOf(database, QStringLiteral("SELECT count(*) FROM key_frames"));
  for (const Result<QVariant>* read : {&source, &started, &key_frames}) {
    if (!*read) return fail(read->error());
  }
  scan.source = source->toString().toStdString();
  scan.started = started->toString().toStdString();
  scan.key_frames = key_frames->toInt();
  return std::optional(std::move(scan));
}

std::optional<ScanOfObject> scanIn(const std::filesystem::path& folder, const std::string& catalogue,
                                   const std::set<ObjectId>& objects) {
  for (int i = 1;; ++i) {
    const auto database = DatabaseConnection::openToRead((folder / "session.sqlite").string());
    if (!database) return std::nullopt;
    const Result<std::optional<ScanOfObject>> scan = readScan(**database, catalogue, objects);
    if (!(*database)->isStill() && i < kReadingTries) continue;
    if (!scan || !*scan) return std::nullopt;
    std::optional<ScanOfObject> found = *scan;
    found->folder = folder;
    return found;
  }
}

}  // namespace

std::vector<ScanOfObject> scansOfObject(const std::filesystem::path& folder, const std::string& catalogue,
                                        const std::set<ObjectId>& objects) {
  std::vector<ScanOfObject> scans;
  if (catalogue.empty()) return scans;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (!SessionStore::isSession(entry->path())) continue;
    if (auto scan = scanIn(entry->path(), catalogue, objects)) scans.push_back(std::move(*scan));
  }
  std::ranges::sort(scans, [](const ScanOfObject& a, const ScanOfObject& b) {
    return std::pair(b.started, a.folder) < std::pair(a.started, b.folder);
  });
  return scans;
}

}  // namespace scantrove
