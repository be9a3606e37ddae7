#include "core/catalogue/different_objects.h"

#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>

#include "core/catalogue/event_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

constexpr const char* kOtherKey = "different_from";

}  // namespace

Result<std::set<ObjectPair>> DifferentObjects::pairs() {
  Result<QSqlQuery> query =
      connection_.execute("SELECT action, object, after_json FROM events WHERE action IN (?, ?) ORDER BY id",
                          {QString(action::kDifferent), QString(action::kDifferentUndone)});
  if (!query) return fail(query.error());
  std::set<ObjectPair> pairs;
  while (query->next()) {
    const QJsonObject json = QJsonDocument::fromJson(query->value(2).toByteArray()).object();
    const ObjectId a{query->value(1).toUInt()}, b{static_cast<std::uint32_t>(json[kOtherKey].toInteger())};
    if (!a || !b) continue;
    if (query->value(0).toString() == action::kDifferent) {
      pairs.insert(std::minmax(a, b));
    } else {
      pairs.erase(std::minmax(a, b));
    }
  }
  return pairs;
}

Result<void> DifferentObjects::record(ObjectId a, ObjectId b, bool are_different) {
  return inTransaction(connection_, [&]() -> Result<void> {
    const ObjectPair pair = std::minmax(a, b);
    return recordEvent(connection_, are_different ? action::kDifferent : action::kDifferentUndone, pair.first,
                       {}, {{kOtherKey, static_cast<qint64>(pair.second.value)}});
  });
}

}  // namespace scantrove
