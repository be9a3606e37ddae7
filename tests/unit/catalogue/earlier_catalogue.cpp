#include "earlier_catalogue.h"

#include <gtest/gtest.h>

#include <QSqlQuery>
#include <QSqlRecord>
#include <QStringList>
#include <QVariant>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "catalogue_test_support.h"
#include "core/catalogue/catalogue_schema.h"
#include "core/catalogue/image_blob.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove::test {
namespace {

constexpr const char* kThen = "2026-01-02T03:04:05.678Z";
constexpr int kObjectOfDiscarded = 7;

struct EarlierTable {
  const char* name;
  const char* key;
  int first_version;
};
constexpr std::array<EarlierTable, 11> kEarlierTables{{{"sessions", "id", 1},
                                                       {"objects", "id", 1},
                                                       {"views", "id", 1},
                                                       {"events", "id", 1},
                                                       {"view_summaries", "view", 2},
                                                       {"descriptors", "view", 2},
                                                       {"pictures", "view", 2},
                                                       {"identity", "one", 6},
                                                       {"applied_edits", "token", 7},
                                                       {"view_vectors", "view", 8},
                                                       {"classes", "id", 9}}};

/// Bytes that differ between views and contain zeros, quotes and backslashes.
QByteArray anyBytes(std::int64_t view, int salt, qsizetype count) {
  QByteArray bytes(count, '\0');
  auto state = static_cast<std::uint32_t>(view * 7919 + salt);
  for (char& byte : bytes) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<char>(state >> 24U);
  }
  return bytes;
}

/// Writes rows with the columns that the version had.
class EarlierWriter {
 public:
  EarlierWriter(DatabaseConnection& connection, int version) : connection_(connection), version_(version) {}

  void writeAll() {
    row("sessions", {{"source", "kitchen"}, {"started", kThen}, {"ended", kThen}}, true);
    if (version_ >= 4)
      run("UPDATE sessions SET fx = 525.25, fy = 525.5, cx = 319.5, cy = 239.5, image_width = 640,"
          " image_height = 480");
    for (int id = 1; id <= EarlierCatalogue::kObjects; ++id) {
      writeObject(id);
      writeView(id);
    }
    if (version_ >= 2) run("UPDATE objects SET best_view = id WHERE id NOT IN (3, 7)");
    if (version_ >= 2) run("UPDATE objects SET named_by_person = 1 WHERE id IN (2, 6)");
    if (version_ >= 7)
      row("applied_edits",
          {{"token", EarlierCatalogue::kToken}, {"result", "the \"result\""}, {"applied", kThen}});
  }

 private:
  void run(const QString& sql, const QVariantList& values = {}) {
    const Result<QSqlQuery> done = connection_.execute(sql, values);
    ASSERT_TRUE(done) << done.error().message();
  }
  void row(const QString& table, const std::vector<std::pair<QString, QVariant>>& columns,
           bool has_automatic_id = false) {
    QStringList names, marks;
    QVariantList values;
    for (const auto& [name, value] : columns) {
      names << name;
      marks << QStringLiteral("?");
      values << value;
    }
    const QString sql =
        QString("INSERT INTO %1 (%2) VALUES (%3)").arg(table, names.join(", "), marks.join(", "));
    if (!has_automatic_id) return run(sql, values);
    const Result<std::int64_t> id = connection_.insert(sql, values);
    ASSERT_TRUE(id) << id.error().message();
  }
  /// `before` and `after` as the first version wrote them; later ones say more in them.
  void event(const char* action, int object, const QVariant& before, const QVariant& after) {
    row("events",
        {{"created", kThen},
         {"action", action},
         {"object", object},
         {"session", 1},
         {"before_json", before},
         {"after_json", after}},
        true);
  }
  [[nodiscard]] QString nameOf(int id) const {
    if (id == 2) return "blue mug";
    if (id == 5) return "Obj_5 (2)";
    if (id == 6) return EarlierCatalogue::kNameOfSix;
    return id == kObjectOfDiscarded ? QString("Discarded views") : QString("Obj_%1").arg(id);
  }
  void writeObject(int id) {
    const bool is_hidden = id == 3 || id == 4 || id == kObjectOfDiscarded;
    // Numbers below 0 came with version 8.
    const int number = id == kObjectOfDiscarded && version_ >= 8 ? -1 : id;
    row("objects",
        {{"number", number},
         {"name", nameOf(id)},
         {"confirmed", id == 2 ? 1 : 0},
         {"hidden", is_hidden ? 1 : 0},
         {"merged_into", id == 3 ? QVariant(1) : QVariant(QMetaType(QMetaType::Int))},
         {"size_x_m", 0.3F},
         {"size_y_m", 0.2F},
         {"size_z_m", 0.1F},
         {"first_session", 1},
         {"created", kThen}},
        true);
    const QVariant none{QMetaType(QMetaType::QString)};
    event("add", id, none, QString(R"({"name":"Obj_%1"})").arg(id));
    const QString plain = R"({"confirmed":false,"hidden":false,"name":"Obj_%1"})";
    if (id == 2)
      event("rename", id, plain.arg(id), R"({"confirmed":false,"hidden":false,"name":"blue mug"})");
    if (id == 3)
      event("merge", id, plain.arg(id),
            R"({"confirmed":false,"hidden":true,"merged_into":1,"name":"Obj_3"})");
    if (id == 4) event("remove", id, plain.arg(id), R"({"confirmed":false,"hidden":true,"name":"Obj_4"})");
  }
  void writeView(int id) {
    const ObjectView view = randomView(EarlierCatalogue::seedOf(id));
    row("views",
        {{"object", id == 3 ? 1 : id},
         {"first_object", id},
         {"session", 1},
         {"frame_index", id * 10},
         {"pose", "1 0 0 0.25 0 1 0 -0.5 0 0 1 0.1"},
         {"direction_x", 0.0},
         {"direction_y", 0.6},
         {"direction_z", -0.8},
         {"created", kThen},
         {"color", toPng(view.color)},
         {"mask", toPng(view.mask)},
         {"depth_mm", toPng(view.depth_mm)}},
        true);
    if (version_ >= 3)
      run("UPDATE views SET box_x = 5, box_y = 20, box_width = 40, box_height = 30, frame_width = 640,"
          " frame_height = 480 WHERE id = ?",
          {id});
    if (version_ >= 2) writeSummary(id);
  }
  void writeSummary(int id) {
    row("view_summaries", {{"view", id},
                           {"first_object", id},
                           {"object_pixels", 200 + id},
                           {"size_x_m", 0.3F},
                           {"size_y_m", 0.2F},
                           {"size_z_m", 0.1F}});
    if (version_ >= 5)
      run("UPDATE view_summaries SET session = 1, place_x_m = 1.5, place_y_m = -0.25, place_z_m = ?"
          " WHERE view = ?",
          {id, id});
    row("descriptors", {{"view", id},
                        {"mean_l", 50.5F},
                        {"mean_a", -3.25F},
                        {"mean_b", 0.1F},
                        {"fine", EarlierCatalogue::thumbnailOf(id)}});
    row("pictures", {{"view", id}, {"jpeg", anyBytes(id, 3, 500)}});
    if (version_ < 8) return;
    run("UPDATE descriptors SET colors = ? WHERE view = ?", {EarlierCatalogue::colorsOf(id), id});
    row("view_vectors",
        {{"view", id}, {"network", QString(64, u'a')}, {"vector", QByteArray("\0\0\x80\x3f", 4)}});
  }

  DatabaseConnection& connection_;
  const int version_;
};

/// Equal for SQLite and PostgreSQL, whose drivers give other types of numbers.
QByteArray plainValue(const QVariant& value) {
  return value.metaType().id() == QMetaType::QByteArray ? value.toByteArray() : value.toString().toUtf8();
}

}  // namespace

void EarlierCatalogue::write(const std::string& database, int version) {
  const auto connection = DatabaseConnection::open(database);
  ASSERT_TRUE(connection) << connection.error().message();
  const auto steps = schema::catalogueSteps().first(static_cast<std::size_t>(version));
  const Result<void> made = schema::migrate(**connection, schema::kCatalogue, steps);
  ASSERT_TRUE(made) << made.error().message();
  const Result<void> written = inTransaction(**connection, [&]() -> Result<void> {
    EarlierWriter(**connection, version).writeAll();
    return {};
  });
  ASSERT_TRUE(written) << written.error().message();
}

QByteArray EarlierCatalogue::thumbnailOf(std::int64_t view) { return anyBytes(view, 1, 3 * 32 * 32); }

QByteArray EarlierCatalogue::colorsOf(std::int64_t view) { return anyBytes(view, 2, 5 * 11 * 11); }

std::map<QString, std::vector<StoredRow>> storedRows(const std::string& database) {
  std::map<QString, std::vector<StoredRow>> tables;
  const auto connection = DatabaseConnection::openToRead(database);
  EXPECT_TRUE(connection) << connection.error().message();
  if (!connection) return tables;
  const auto version = schema::versionToRead(**connection, schema::kCatalogue, schema::catalogueSteps(), 1);
  EXPECT_TRUE(version) << version.error().message();
  for (const EarlierTable& table : kEarlierTables) {
    if (table.first_version > version.value_or(0)) continue;
    Result<QSqlQuery> query =
        (*connection)->execute(QString("SELECT * FROM %1 ORDER BY %2").arg(table.name, table.key));
    EXPECT_TRUE(query) << query.error().message();
    std::vector<StoredRow>& rows = tables[table.name];
    while (query && query->next()) {
      StoredRow& row = rows.emplace_back();
      const QSqlRecord record = query->record();
      for (int i = 0; i < record.count(); ++i) {
        if (!query->isNull(i)) row[record.fieldName(i)] = plainValue(query->value(i));
      }
    }
  }
  return tables;
}

void expectKept(const std::map<QString, std::vector<StoredRow>>& before,
                const std::map<QString, std::vector<StoredRow>>& after) {
  for (const auto& [table, rows] : before) {
    const auto found = after.find(table);
    ASSERT_NE(found, after.end()) << table.toStdString();
    ASSERT_EQ(found->second.size(), rows.size()) << table.toStdString();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (const auto& [column, value] : rows[i]) {
        const auto kept = found->second[i].find(column);
        EXPECT_TRUE(kept != found->second[i].end() && kept->second == value)
            << table.toStdString() << ", row " << i << ", " << column.toStdString();
      }
    }
  }
}

}  // namespace scantrove::test
