#include "core/session/replaced_session.h"

#include <QString>

#include "core/session/own_files.h"

namespace scantrove {
namespace {

/// Tables of schema/, without `schema_migrations` and `files`. Tables of others stay.
constexpr const char* kTables[] = {"facts",     "fact_copies", "frames",           "key_frames",
                                   "fragments", "regions",     "borders",          "operations",
                                   "camera",    "pages",       "recordings",       "table_sums",
                                   "estimates", "objectness",  "mask_corrections", "frame_reviews"};

}  // namespace

Result<void> checkIsUnlabeled(DatabaseConnection& database, const std::filesystem::path& folder) {
  Result<QSqlQuery> count = database.execute("SELECT count(*) FROM operations");
  if (!count) return fail(count.error());
  if (!count->next() || count->value(0).toInt() == 0) return {};
  return fail("In " + folder.string() + " there is a scan that somebody has labelled.",
              "Go on in it with --resume, or name another folder.");
}

Result<void> clearSession(DatabaseConnection& database) {
  // Key frames are deleted after the frames that they refer to.
  SCANTROVE_TRY(database.execute("PRAGMA defer_foreign_keys = ON"));
  for (const char* table : kTables) SCANTROVE_TRY(database.execute(QString("DELETE FROM ") + table));
  // The time at which the session started.
  SCANTROVE_TRY(database.execute("UPDATE schema_migrations SET applied = ? WHERE version = 1",
                                 {DatabaseConnection::now()}));
  const Result<std::vector<std::string>> files = own_files::kept(database);
  if (!files) return fail(files.error());
  return own_files::outdate(database, *files);
}

}  // namespace scantrove
