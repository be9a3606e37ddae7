#include "core/catalogue/catalogue_sessions.h"

#include <QDateTime>

#include "core/catalogue/event_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

/// Kernels may be compiled between the start of a session and of its part in the catalogue.
constexpr qint64 kBetweenBeginnings_s = 600;

}  // namespace

Result<std::int64_t> CatalogueSessions::begin(const std::string& source,
                                              const std::optional<Intrinsics>& camera) {
  return inTransaction(connection_, [&]() -> Result<std::int64_t> {
    const QString name = QString::fromStdString(source);
    Result<std::int64_t> id = connection_.insert("INSERT INTO sessions (source, started) VALUES (?, ?)",
                                                 {name, DatabaseConnection::now()});
    if (!id) return id;
    if (camera) {
      SCANTROVE_TRY(
          connection_.execute("UPDATE sessions SET fx = ?, fy = ?, cx = ?, cy = ?, image_width = ?, "
                              "image_height = ? WHERE id = ?",
                              {camera->fx, camera->fy, camera->cx, camera->cy, camera->width, camera->height,
                               static_cast<qlonglong>(*id)}));
    }
    SCANTROVE_TRY(recordEvent(connection_, action::kSessionBegin, {}, {}, {{"source", name}}, *id));
    return id;
  });
}

Result<void> CatalogueSessions::end(std::int64_t session) {
  return inTransaction(connection_, [&]() -> Result<void> {
    const Result<QSqlQuery> done =
        connection_.execute("UPDATE sessions SET ended = ? WHERE id = ?",
                            {DatabaseConnection::now(), static_cast<qlonglong>(session)});
    if (!done) return fail(done.error());
    if (done->numRowsAffected() != 1) {
      return fail("The database " + connection_.file() + " holds no session " + std::to_string(session) +
                  ".");
    }
    return recordEvent(connection_, action::kSessionEnd, {}, {}, {}, session);
  });
}

Result<std::map<std::int64_t, Intrinsics>> CatalogueSessions::cameras() {
  std::map<std::int64_t, Intrinsics> cameras;
  if (!has_cameras_) return cameras;
  Result<QSqlQuery> query = connection_.execute(
      "SELECT id, fx, fy, cx, cy, image_width, image_height FROM sessions WHERE fx IS NOT NULL");
  if (!query) return fail(query.error());
  while (query->next()) {
    const auto number = [&](int column) { return query->value(column).toFloat(); };
    cameras[query->value(0).toLongLong()] = {
        number(1), number(2), number(3), number(4), query->value(5).toInt(), query->value(6).toInt()};
  }
  return cameras;
}

Result<bool> CatalogueSessions::hasScanOf(const std::string& begun) {
  const QDateTime time = QDateTime::fromString(QString::fromStdString(begun), Qt::ISODateWithMs);
  if (!time.isValid()) return false;
  const auto text = [&](qint64 later_s) { return time.toUTC().addSecs(later_s).toString(Qt::ISODateWithMs); };
  Result<QSqlQuery> count = connection_.execute("SELECT count(*) FROM sessions WHERE started BETWEEN ? AND ?",
                                                {text(-kBetweenBeginnings_s), text(kBetweenBeginnings_s)});
  if (!count) return fail(count.error());
  return count->next() && count->value(0).toInt() > 0;
}

}  // namespace scantrove
