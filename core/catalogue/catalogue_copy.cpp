#include "core/catalogue/catalogue_copy.h"

#include <QSqlQuery>
#include <QSqlRecord>
#include <QStringList>
#include <QVariant>
#include <memory>
#include <string_view>
#include <vector>

#include "core/catalogue/catalogue_schema.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

/// A table, its key, and columns that refer to rows which are copied later.
struct CopiedTable {
  const char* name;
  const char* key;
  std::vector<const char*> later_columns = {};
};

/// Referred tables come first.
const std::vector<CopiedTable>& copiedTables() {
  static const std::vector<CopiedTable> tables{{"sessions", "id"},
                                               {"classes", "id", {"merged_into"}},
                                               {"objects", "id", {"merged_into", "best_view"}},
                                               {"views", "id"},
                                               {"view_summaries", "view"},
                                               {"descriptors", "view"},
                                               {"view_vectors", "view"},
                                               {"pictures", "view"},
                                               {"events", "id"},
                                               {"applied_edits", "token"}};
  return tables;
}

constexpr int kRowsOfAPage = 64;  // a view has some hundred kilobytes

/// A value as both databases bind it: SQLite's driver returns no bytes as null.
QVariant copiedValue(const QSqlQuery& row, int column) {
  QVariant value = row.value(column);
  if (row.isNull(column)) return QVariant(QMetaType(QMetaType::QString));
  if (value.metaType().id() == QMetaType::QByteArray && value.toByteArray().isEmpty()) return QByteArray("");
  return value;
}

class CatalogueCopier {
 public:
  CatalogueCopier(DatabaseConnection& from, DatabaseConnection& to) : from_(from), to_(to) {}

  Result<CatalogueCopy> run() {
    SCANTROVE_TRY(checkIsEmpty());
    for (const CopiedTable& table : copiedTables()) SCANTROVE_TRY(copyRows(table));
    for (const CopiedTable& table : copiedTables()) SCANTROVE_TRY(copyLater(table));
    SCANTROVE_TRY(copyIdentity());
    for (const CopiedTable& table : copiedTables()) SCANTROVE_TRY(finish(table));
    to_.announceChange();
    CatalogueCopy copied;
    SCANTROVE_TRY(moveInto(copied.objects, count(to_, "objects WHERE hidden = 0")));
    SCANTROVE_TRY(moveInto(copied.views, count(to_, "views")));
    SCANTROVE_TRY(moveInto(copied.classes, count(to_, "classes WHERE hidden = 0")));
    SCANTROVE_TRY(moveInto(copied.events, count(to_, "events")));
    return copied;
  }

 private:
  static Result<std::int64_t> count(DatabaseConnection& connection, const QString& what) {
    Result<QSqlQuery> query = connection.execute("SELECT count(*) FROM " + what);
    if (!query) return fail(query.error());
    return query->next() ? query->value(0).toLongLong() : 0;
  }

  Result<void> checkIsEmpty() {
    for (const CopiedTable& table : copiedTables()) {
      const Result<std::int64_t> rows = count(to_, table.name);
      if (!rows) return fail(rows.error());
      if (*rows > 0) {
        return fail("The catalogue " + to_.file() + " is not empty, so nothing was copied into it.",
                    "Give a new file, or an empty database.");
      }
    }
    return {};
  }

  Result<QStringList> columnsOf(const CopiedTable& table) {
    const Result<QSqlQuery> none =
        from_.execute(QString("SELECT * FROM %1 WHERE 1 = 0").arg(QLatin1String(table.name)));
    if (!none) return fail(none.error());
    const QSqlRecord record = none->record();
    QStringList columns;
    for (int i = 0; i < record.count(); ++i) columns.push_back(record.fieldName(i));
    return columns;
  }

  Result<void> copyRows(const CopiedTable& table) {
    Result<QStringList> columns = columnsOf(table);
    if (!columns) return fail(columns.error());
    for (const char* later : table.later_columns) columns->removeAll(QLatin1String(later));
    const auto key = static_cast<int>(columns->indexOf(QLatin1String(table.key)));
    const QString list = columns->join(QStringLiteral(", "));
    const QString insert =
        QString("INSERT INTO %1 (%2) VALUES (%3)")
            .arg(QLatin1String(table.name), list,
                 QStringList(columns->size(), QStringLiteral("?")).join(QStringLiteral(", ")));
    const QString select = QString("SELECT %1 FROM %2%3 ORDER BY %4 LIMIT %5");
    QVariant last;
    for (int rows = kRowsOfAPage; rows == kRowsOfAPage;) {
      const QString after =
          last.isValid() ? QString(" WHERE %1 > ?").arg(QLatin1String(table.key)) : QString();
      Result<QSqlQuery> page =
          from_.execute(select.arg(list, QLatin1String(table.name), after, QLatin1String(table.key),
                                   QString::number(kRowsOfAPage)),
                        last.isValid() ? QVariantList{last} : QVariantList{});
      if (!page) return fail(page.error());
      for (rows = 0; page->next(); ++rows) {
        QVariantList values;
        for (int i = 0; i < columns->size(); ++i) values.push_back(copiedValue(*page, i));
        last = values[key];
        SCANTROVE_TRY(to_.execute(insert, values));
      }
    }
    return {};
  }

  Result<void> copyLater(const CopiedTable& table) {
    for (const char* column : table.later_columns) {
      Result<QSqlQuery> rows = from_.execute(QString("SELECT id, %1 FROM %2 WHERE %1 IS NOT NULL")
                                                 .arg(QLatin1String(column), QLatin1String(table.name)));
      if (!rows) return fail(rows.error());
      while (rows->next()) {
        SCANTROVE_TRY(
            to_.execute(QString("UPDATE %1 SET %2 = ? WHERE id = ?").arg(QLatin1String(table.name), column),
                        {rows->value(1), rows->value(0)}));
      }
    }
    return {};
  }

  Result<void> copyIdentity() {
    Result<QSqlQuery> identity = from_.execute("SELECT uuid FROM identity");
    if (!identity) return fail(identity.error());
    if (!identity->next()) return fail(damagedDatabase(from_.file(), "it has lost its identity"));
    SCANTROVE_TRY(to_.execute("UPDATE identity SET uuid = ?", {identity->value(0)}));
    return {};
  }

  /// Compares the number of rows, and lets automatic ids continue after the copied ones.
  Result<void> finish(const CopiedTable& table) {
    const Result<std::int64_t> before = count(from_, table.name), after = count(to_, table.name);
    if (!before) return fail(before.error());
    if (!after) return fail(after.error());
    if (*before != *after)
      return fail(damagedDatabase(from_.file(),
                                  std::string("not all rows of the table ") + table.name + " can be read"));
    if (!to_.isOnServer() || std::string_view(table.key) != "id") return {};
    SCANTROVE_TRY(
        to_.execute(QString("SELECT setval(pg_get_serial_sequence('%1', 'id'), coalesce(max(id), 1),"
                            " max(id) IS NOT NULL) FROM %1")
                        .arg(QLatin1String(table.name))));
    return {};
  }

  DatabaseConnection& from_;
  DatabaseConnection& to_;
};

}  // namespace

Result<CatalogueCopy> copyCatalogue(const std::string& from, const std::string& to) {
  if (from == to)
    return fail("The catalogue " + from + " cannot be copied onto itself.", "Give another one.");
  const auto source = DatabaseConnection::openToRead(from);
  if (!source) return fail(source.error());
  const Result<ReadSnapshot> snapshot = ReadSnapshot::begin(**source);
  if (!snapshot) return fail(snapshot.error());
  const auto steps = schema::catalogueSteps();
  const auto version =
      schema::versionToRead(**source, schema::kCatalogue, steps, static_cast<int>(steps.size()));
  if (!version) return fail(version.error());
  const auto target = DatabaseConnection::open(to);
  if (!target) return fail(target.error());
  SCANTROVE_TRY(schema::migrate(**target, schema::kCatalogue, steps));
  return inTransaction(**target, [&]() -> Result<CatalogueCopy> {
    Result<CatalogueCopy> copied = CatalogueCopier(**source, **target).run();
    if (copied && !(*source)->isStill()) {
      return fail("The catalogue " + from + " was changed while it was copied.", "Copy it again.");
    }
    return copied;
  });
}

}  // namespace scantrove
