#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "catalogue_test_support.h"
#include "core/catalogue/catalogue_schema.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"
#include "tests/support/captured_log.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class DatabaseFailuresTest : public CatalogueTest {
 protected:
  static std::string messageOf(const std::string& database) {
    const Result<std::unique_ptr<ObjectDatabase>> opened = ObjectDatabase::open(database);
    return opened ? "(opened)" : opened.error().message();
  }
  void write(const std::string& text, const std::string& name = "catalogue.sqlite") const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
};

TEST_F(DatabaseFailuresTest, NamesTheFile_WhenItIsNoDatabase) {
  write("This is a letter, and longer than the header of a database file would be.\n");
  EXPECT_THAT(messageOf(file()),
              AllOf(HasSubstr(file()), HasSubstr("is not a database"), HasSubstr("another file")));
  write("short");
  EXPECT_THAT(messageOf(file()), HasSubstr("is not a database"));
  std::string forged(4096, 'x');
  forged.replace(0, 16, std::string("SQLite format 3\0", 16));
  write(forged);
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("is not a database")));
}

TEST_F(DatabaseFailuresTest, MakesACatalogue_WhenTheFileIsEmpty) {
  write("");
  EXPECT_EQ(messageOf(file()), "(opened)");
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "9");
}

TEST_F(DatabaseFailuresTest, RefusesUnchanged_WhenTheDatabaseIsAnotherPrograms) {
  askSqlite(file(), "CREATE TABLE bookmarks (url TEXT)");
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("another program")));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sqlite_master"), "1");
  EXPECT_EQ(askSqlite(file(), "PRAGMA journal_mode"), "delete") << "the file is not changed";
}

TEST_F(DatabaseFailuresTest, RefusesUnchanged_WhenTheFileHasFewBytes) {
  for (const char* text : {"x", "SQLite format 3", "SQLite format 3\n and more"}) {
    write(text);
    EXPECT_THAT(messageOf(file()), HasSubstr("is not a database")) << text;
    EXPECT_EQ(std::filesystem::file_size(file()), std::string(text).size());
  }
}

TEST_F(DatabaseFailuresTest, NamesThePath_WhenItIsALoopTooLongOrAPipe) {
  std::filesystem::create_symlink(file("b"), file("a"));
  std::filesystem::create_symlink(file("a"), file("b"));
  EXPECT_THAT(messageOf(file("a")), HasSubstr(file("a")));
  EXPECT_THAT(messageOf(file(std::string(300, 'x'))), HasSubstr("xxx"));
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  EXPECT_THAT(messageOf(file("pipe")), HasSubstr("not a regular file"));
}

TEST_F(DatabaseFailuresTest, NamesTheTable_WhenItIsMissing) {
  for (const char* table : {"views", "events", "descriptors", "objects"}) {
    std::filesystem::remove(file());
    {
      const auto database = openOrFail(file());
      ASSERT_TRUE(database->addObject(randomView(0)));
    }
    askSqlite(file(), QString("DROP TABLE %1").arg(table));
    const auto database = openOrFail(file());
    ASSERT_NE(database, nullptr);
    const Result<ObjectRecord> added = database->addObject(randomView(1));
    ASSERT_FALSE(added);
    EXPECT_THAT(added.error().message(),
                AllOf(HasSubstr(file()), HasSubstr("is damaged"), HasSubstr(table), HasSubstr("backup")));
  }
}

TEST_F(DatabaseFailuresTest, ReportsDamage_WhenTheSchemaVersionIsImpossible) {
  openOrFail(file());
  for (const char* version : {"-1", "0"}) {
    askSqlite(file(), QString("PRAGMA user_version = %1").arg(version));
    EXPECT_THAT(messageOf(file()),
                AllOf(HasSubstr(file()), HasSubstr("damaged"), HasSubstr(std::string("version ") + version)));
  }
  std::filesystem::remove(file());
  askSqlite(file(), "PRAGMA application_id = 1399025268");
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr("damaged"), HasSubstr("without tables")));
}

TEST_F(DatabaseFailuresTest, ReportsOnceAndStaysUsable_WhenTheDiskIsFull) {
  openOrFail(file());
  const auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  ASSERT_TRUE((*connection)->execute("PRAGMA max_page_count = 40"));
  const CapturedLog log;
  const auto store = [&](int kilobytes) {
    return inTransaction(**connection, [&]() -> Result<void> {
      SCANTROVE_TRY((*connection)->execute("CREATE TABLE IF NOT EXISTS filler (bytes BLOB)"));
      SCANTROVE_TRY(
          (*connection)->execute("INSERT INTO filler VALUES (?)", {QByteArray(1024 * kilobytes, 'x')}));
      return {};
    });
  };
  const Result<void> refused = store(400);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(),
              AllOf(HasSubstr(file()), HasSubstr("disk is full"), HasSubstr("Free some space")));
  EXPECT_TRUE(store(1)) << "the connection stays usable";
  EXPECT_EQ(log.text(), "") << "the error is returned, not logged as well";
}

TEST_F(DatabaseFailuresTest, ReportsDamage_WhenTheFileIsTruncated) {
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(database->addObject(randomView(i, {80, 60})));
  }
  const std::string complete = file("complete.sqlite");
  std::filesystem::copy_file(file(), complete);
  for (const std::uintmax_t size : {100U, 4096U, 40000U, 100001U}) {
    std::filesystem::remove(file());
    std::filesystem::copy_file(complete, file());
    ASSERT_LT(size, std::filesystem::file_size(file()));
    std::filesystem::resize_file(file(), size);
    EXPECT_THAT(messageOf(file()),
                AllOf(HasSubstr(file()), testing::AnyOf(HasSubstr("damaged"), HasSubstr("not a database"))))
        << size;
  }
}

TEST_F(DatabaseFailuresTest, NamesThePath_WhenItIsAFolderOrMissing) {
  EXPECT_THAT(messageOf(folder_.string()), AllOf(HasSubstr(folder_.string()), HasSubstr("is a folder")));
  EXPECT_THAT(messageOf(file("missing/catalogue.sqlite")),
              AllOf(HasSubstr("missing"), HasSubstr("does not exist")));
  EXPECT_FALSE(std::filesystem::exists(file("missing")));
  EXPECT_THAT(messageOf(""), HasSubstr("No database"));
}

TEST_F(DatabaseFailuresTest, NamesTheFile_WhenItCannotBeCreated) {
  // Root cannot write to /proc either.
  EXPECT_THAT(messageOf("/proc/catalogue.sqlite"), HasSubstr("/proc/catalogue.sqlite"));
}

/// Runs as user nobody while it lives, so that permissions apply to root, too.
class AsNobody {
 public:
  AsNobody() { EXPECT_TRUE(user_ != 0 || ::setresuid(kNobody, kNobody, 0) == 0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;
  ~AsNobody() { EXPECT_TRUE(user_ != 0 || ::setresuid(0, 0, 0) == 0); }

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t user_ = ::geteuid();
};

TEST_F(DatabaseFailuresTest, NamesFileOrFolder_WhenItIsReadOnly) {
  using std::filesystem::perms;
  openOrFail(file());
  std::filesystem::permissions(folder_, perms::all);
  std::filesystem::permissions(file(), perms::owner_read | perms::group_read | perms::others_read);
  {
    const AsNobody nobody;
    EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("may not read and write")));
  }
  std::filesystem::permissions(file(), perms::all);
  std::filesystem::permissions(folder_,
                               perms::all & ~(perms::owner_write | perms::group_write | perms::others_write));
  {
    const AsNobody nobody;
    EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(folder_.string()), HasSubstr("may not write")));
  }
  std::filesystem::permissions(folder_, perms::owner_all);
}

TEST_F(DatabaseFailuresTest, ReportsTheLock_WhenAnotherConnectionHoldsIt) {
  const auto database = openOrFail(file());
  const auto other = DatabaseConnection::open(file());
  ASSERT_TRUE(other);
  ASSERT_TRUE((*other)->execute("BEGIN EXCLUSIVE"));
  const Result<ObjectRecord> refused = database->addObject(randomView(0));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), AllOf(HasSubstr(file()), HasSubstr("locked")));
  ASSERT_TRUE((*other)->execute("ROLLBACK"));
  EXPECT_TRUE(database->addObject(randomView(0)));
}

TEST_F(DatabaseFailuresTest, NamesTheVersion_WhenTheSchemaIsNewer) {
  openOrFail(file());
  askSqlite(file(), "PRAGMA user_version = 999");
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("newer"), HasSubstr("999")));
}

TEST_F(DatabaseFailuresTest, RunsMigrationsInOrderAndOnce) {
  auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  std::vector<schema::Migration> steps(schema::catalogueSteps().begin(), schema::catalogueSteps().end());
  EXPECT_TRUE(schema::migrate(**connection, schema::kCatalogue, steps));
  const int first = static_cast<int>(steps.size());
  steps.push_back(
      {first + 1, "a.sql", "-- a comment; with a semicolon\nALTER TABLE objects ADD COLUMN note TEXT;"});
  steps.push_back({first + 2, "b.sql", "UPDATE objects SET note = 'x'; CREATE TABLE extra (id INTEGER);"});
  EXPECT_TRUE(schema::migrate(**connection, schema::kCatalogue, steps));
  EXPECT_TRUE(schema::migrate(**connection, schema::kCatalogue, steps));
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), std::to_string(first + 2));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM schema_migrations"), std::to_string(first + 2));
}

TEST_F(DatabaseFailuresTest, ChangesNothing_WhenAMigrationFails) {
  openOrFail(file());
  auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  std::vector<schema::Migration> steps(schema::catalogueSteps().begin(), schema::catalogueSteps().end());
  const int first = static_cast<int>(steps.size());
  steps.push_back({first + 1, "good.sql", "CREATE TABLE extra (id INTEGER);"});
  steps.push_back({first + 2, "bad.sql", "CREATE TABLE more (id INTEGER); SELECT nonsense FROM nowhere;"});
  const Result<void> done = schema::migrate(**connection, schema::kCatalogue, steps);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), HasSubstr(file()));
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), std::to_string(first));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sqlite_master WHERE name IN ('extra', 'more')"), "0");
}

}  // namespace
}  // namespace scantrove::test
