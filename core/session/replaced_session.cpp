#include "core/session/replaced_session.h"

#include <QStringList>

#include "core/session/own_files.h"

namespace scantrove {

Result<void> checkIsUnlabeled(DatabaseConnection& database, const std::filesystem::path& folder) {
  Result<QSqlQuery> count = database.execute("SELECT count(*) FROM operations");
  if (!count) return fail(count.error());
  if (!count->next() || count->value(0).toInt() == 0) return {};
  return fail("In " + folder.string() + " there is a scan that somebody has labelled.",
              "Go on in it with --resume, or name another folder.");
}

Result<void> clearSession(DatabaseConnection& database) {
  // Key frames go after the frames that they refer to.
  SCANTROVE_TRY(database.execute("PRAGMA defer_foreign_keys = ON"));
  QStringList tables;
  {
    Result<QSqlQuery> names = database.execute(
        "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite!_%' ESCAPE '!'"
        " AND name NOT IN ('schema_migrations', 'files')");
    if (!names) return fail(names.error());
    while (names->next()) tables << names->value(0).toString();
  }
  for (QString& table : tables)
    SCANTROVE_TRY(database.execute("DELETE FROM \"" + table.replace('"', "\"\"") + '"'));
  // It is when the session began.
  SCANTROVE_TRY(database.execute("UPDATE schema_migrations SET applied = ? WHERE version = 1",
                                 {DatabaseConnection::now()}));
  const Result<std::vector<std::string>> files = own_files::kept(database);
  if (!files) return fail(files.error());
  return own_files::outdate(database, *files);
}

}  // namespace scantrove
