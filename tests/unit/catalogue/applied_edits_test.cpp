#include <array>

#include "catalogue_test_support.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove::test {
namespace {

class AppliedEditsTest : public CatalogueTest {
 protected:
  /// Calls that a session makes in one edit when a user names a region.
  static Result<std::string> nameNewObject(ObjectDatabase& database) {
    const Result<std::int64_t> session = database.sessions().begin("a scan");
    if (!session) return fail(session.error());
    const Result<ObjectRecord> object = database.addObject(randomView(0));
    if (!object) return fail(object.error());
    ObjectView view = randomView(1);
    view.object = object->id;
    const Result<std::int64_t> added = database.addView(view);
    if (!added) return fail(added.error());
    const Result<ObjectNaming> naming = database.nameByUser(object->id, "cup");
    if (!naming) return fail(naming.error());
    SCANTROVE_TRY(database.sessions().end(*session));
    return std::to_string(object->id.value);
  }
  /// Row counts of all tables that an edit writes.
  [[nodiscard]] std::string rows() const {
    return askDatabase(
        file(),
        "SELECT (SELECT count(*) FROM sessions) || ' ' || (SELECT count(*) FROM objects) || ' ' ||"
        " (SELECT count(*) FROM views) || ' ' || (SELECT count(*) FROM view_summaries) || ' ' ||"
        " (SELECT count(*) FROM events) || ' ' || (SELECT count(*) FROM applied_edits)");
  }
};

TEST_F(AppliedEditsTest, RunsOnce_ForEachToken) {
  const auto database = openOrFail(file());
  int runs = 0;
  const auto edit = [&] {
    ++runs;
    return nameNewObject(*database);
  };
  const Result<std::string> first = database->applyOnce("a", edit);
  ASSERT_TRUE(first) << first.error().message();
  EXPECT_EQ(database->applyOnce("a", edit).value_or(""), *first) << "the first result";
  EXPECT_EQ(openOrFail(file())->applyOnce("a", edit).value_or(""), *first) << "another program, later";
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(database->objects()->size(), 1U);
}

TEST_F(AppliedEditsTest, ChangesNothing_WhenAnyStepFails) {
  const auto database = openOrFail(file());
  const std::string before = rows();
  // The edit fails at another step for each missing table.
  for (const char* table : {"sessions", "events", "objects", "views", "view_summaries", "descriptors",
                            "pictures", "applied_edits"}) {
    const auto rename = [&](const QString& from, const QString& to) {
      askDatabase(file(), QString("ALTER TABLE %1 RENAME TO %2").arg(from, to));
    };
    rename(table, "renamed_away");
    EXPECT_FALSE(database->applyOnce("a", [&] { return nameNewObject(*database); })) << table;
    rename("renamed_away", table);
    EXPECT_EQ(rows(), before) << table;
  }
  EXPECT_TRUE(database->applyOnce("a", [&] { return nameNewObject(*database); })) << "the next try";
  EXPECT_EQ(database->objects()->size(), 1U);
}

TEST_F(AppliedEditsTest, RevertsOnlyTheCall_WhenItFails) {
  const auto database = openOrFail(file());
  const Result<std::string> done = database->applyOnce("a", [&]() -> Result<std::string> {
    const Result<ObjectRecord> object = database->addObject(randomView(0));
    if (!object) return fail(object.error());
    const std::array<ObjectId, 2> pair{object->id, ObjectId{77}};
    EXPECT_FALSE(database->remove(pair)) << "object 77 does not exist";
    return std::to_string(object->id.value);
  });
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(database->objects()->size(), 1U) << "the failed call removed none";
}

using InTransactionTest = CatalogueTest;

TEST_F(InTransactionTest, RunsNoMoreStatements_WhenTheDatabaseRolledBack) {
  openOrFail(file());
  const auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  ASSERT_TRUE((*connection)->execute("CREATE TABLE filler (bytes BLOB)"));
  const auto insert = [&](int kilobytes) -> Result<void> {
    SCANTROVE_TRY(
        (*connection)->execute("INSERT INTO filler VALUES (?)", {QByteArray(1024 * kilobytes, 'x')}));
    return {};
  };
  const auto countRows = [&] { return askSqlite(file(), "SELECT count(*) FROM filler"); };
  const Result<void> outer = inTransaction(**connection, [&]() -> Result<void> {
    SCANTROVE_TRY(insert(1));
    const Result<void> inner = inTransaction(**connection, [&]() -> Result<void> {
      // A full disk rolls back everything; ROLLBACK TO fails then.
      SCANTROVE_TRY((*connection)->execute("ROLLBACK"));
      return fail("The disk is full.");
    });
    EXPECT_FALSE(inner);
    EXPECT_FALSE(insert(1)) << "outside the transaction it would be committed by itself";
    return {};
  });
  EXPECT_FALSE(outer);
  EXPECT_EQ(countRows(), "0");
  EXPECT_TRUE(inTransaction(**connection, [&] { return insert(1); })) << "the connection stays usable";
  EXPECT_EQ(countRows(), "1");
}

}  // namespace
}  // namespace scantrove::test
