#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "catalog_test_support.h"
#include "core/catalog/database_connection.h"
#include "core/catalog/migrations.h"

namespace scantrove {
namespace {

using test::askSqlite;
using test::CatalogTest;
using test::openOrFail;
using test::randomView;
using testing::AllOf;
using testing::HasSubstr;

class DatabaseFailures : public CatalogTest {
 protected:
  static std::string messageOf(const std::string& database) {
    const Result<std::unique_ptr<ObjectDatabase>> opened = ObjectDatabase::open(database);
    return opened ? "(opened)" : opened.error().message();
  }
  void write(const std::string& text, const std::string& name = "catalogue.sqlite") const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
};

TEST_F(DatabaseFailures, NotADatabase) {
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

TEST_F(DatabaseFailures, AnEmptyFileBecomesACatalogue) {
  write("");
  EXPECT_EQ(messageOf(file()), "(opened)");
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "2");
}

TEST_F(DatabaseFailures, AnotherProgramsDatabase) {
  askSqlite(file(), "CREATE TABLE bookmarks (url TEXT)");
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("another program")));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sqlite_master"), "1");
}

TEST_F(DatabaseFailures, Truncated) {
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(database->addObject(randomView(i, {80, 60})));
  }
  const std::string whole = file("whole.sqlite");
  std::filesystem::copy_file(file(), whole);
  for (const std::uintmax_t size : {100U, 4096U, 40000U, 100001U}) {
    std::filesystem::remove(file());
    std::filesystem::copy_file(whole, file());
    ASSERT_LT(size, std::filesystem::file_size(file()));
    std::filesystem::resize_file(file(), size);
    EXPECT_THAT(messageOf(file()),
                AllOf(HasSubstr(file()), testing::AnyOf(HasSubstr("damaged"), HasSubstr("not a database"))))
        << size;
  }
}

TEST_F(DatabaseFailures, FoldersAndMissingFolders) {
  EXPECT_THAT(messageOf(folder_.string()), AllOf(HasSubstr(folder_.string()), HasSubstr("is a folder")));
  EXPECT_THAT(messageOf(file("missing/catalogue.sqlite")),
              AllOf(HasSubstr("missing"), HasSubstr("does not exist")));
  EXPECT_FALSE(std::filesystem::exists(file("missing")));
  EXPECT_THAT(messageOf(""), HasSubstr("No database"));
}

TEST_F(DatabaseFailures, PostgresqlIsRefusedClearly) {
  EXPECT_THAT(messageOf("postgresql://someone@host/db"), AllOf(HasSubstr("PostgreSQL"), HasSubstr("SQLite")));
}

TEST_F(DatabaseFailures, AFolderThatCannotBeWritten) {
  // /proc holds for root as well.
  EXPECT_THAT(messageOf("/proc/catalogue.sqlite"), HasSubstr("/proc/catalogue.sqlite"));
}

TEST_F(DatabaseFailures, ReadOnlyFile) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  openOrFail(file());
  std::filesystem::permissions(file(), std::filesystem::perms::owner_read);
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("may not")));
}

TEST_F(DatabaseFailures, Locked) {
  const auto database = openOrFail(file());
  const auto holder = DatabaseConnection::open(file());
  ASSERT_TRUE(holder);
  ASSERT_TRUE((*holder)->execute("BEGIN EXCLUSIVE"));
  const Result<ObjectRecord> refused = database->addObject(randomView(0));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), AllOf(HasSubstr(file()), HasSubstr("locked")));
  ASSERT_TRUE((*holder)->execute("ROLLBACK"));
  EXPECT_TRUE(database->addObject(randomView(0)));
}

TEST_F(DatabaseFailures, ANewerSchema) {
  openOrFail(file());
  askSqlite(file(), "PRAGMA user_version = 999");
  EXPECT_THAT(messageOf(file()), AllOf(HasSubstr(file()), HasSubstr("newer"), HasSubstr("999")));
}

TEST_F(DatabaseFailures, MigrationsRunInOrderAndOnce) {
  auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  std::vector<schema::Migration> steps(schema::migrations().begin(), schema::migrations().end());
  EXPECT_TRUE(schema::migrate(**connection, steps));
  const int first = static_cast<int>(steps.size());
  steps.push_back(
      {first + 1, "a.sql", "-- a comment; with a semicolon\nALTER TABLE objects ADD COLUMN note TEXT;"});
  steps.push_back({first + 2, "b.sql", "UPDATE objects SET note = 'x'; CREATE TABLE extra (id INTEGER);"});
  EXPECT_TRUE(schema::migrate(**connection, steps));
  EXPECT_TRUE(schema::migrate(**connection, steps));
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), std::to_string(first + 2));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM schema_migrations"), std::to_string(first + 2));
}

TEST_F(DatabaseFailures, AFailedMigrationChangesNothing) {
  openOrFail(file());
  auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  std::vector<schema::Migration> steps(schema::migrations().begin(), schema::migrations().end());
  const int first = static_cast<int>(steps.size());
  steps.push_back({first + 1, "good.sql", "CREATE TABLE extra (id INTEGER);"});
  steps.push_back({first + 2, "bad.sql", "CREATE TABLE more (id INTEGER); SELECT nonsense FROM nowhere;"});
  const Result<void> done = schema::migrate(**connection, steps);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), HasSubstr(file()));
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), std::to_string(first));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sqlite_master WHERE name IN ('extra', 'more')"), "0");
}

// --- kill -9: the writer is this test program, started again for one test.

constexpr const char* kWriterFile = "SCANTROVE_TEST_WRITER_FILE";
constexpr const char* kWriterPipe = "SCANTROVE_TEST_WRITER_PIPE";

TEST(DatabaseCrashWriter, WritesUntilItIsKilled) {
  const char* file = std::getenv(kWriterFile);
  const char* pipe = std::getenv(kWriterPipe);
  if (file == nullptr || pipe == nullptr) GTEST_SKIP() << "runs only as the child of DatabaseCrash";
  const auto database = openOrFail(file);
  const int out = std::atoi(pipe);
  for (int i = 0;; ++i) {
    const ObjectRecord added = *database->addObject(randomView(i, {300, 200}));
    if (::write(out, &added.id.value, sizeof(added.id.value)) < 0) break;
  }
}

class DatabaseCrash : public CatalogTest {
 protected:
  /// Starts a writer, kills it after `objects` were reported as stored; returns the ids reported.
  std::vector<std::uint32_t> writeAndKill(std::size_t objects) const {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    ::setenv(kWriterFile, file().c_str(), 1);
    ::setenv(kWriterPipe, std::to_string(ends[1]).c_str(), 1);
    const pid_t child = ::fork();
    if (child == 0) {
      ::execl("/proc/self/exe", "writer", "--gtest_filter=DatabaseCrashWriter.*", "--gtest_brief=1", nullptr);
      ::_exit(127);
    }
    ::unsetenv(kWriterFile);
    ::unsetenv(kWriterPipe);
    ::close(ends[1]);
    std::vector<std::uint32_t> ids;
    std::uint32_t id = 0;
    while (::read(ends[0], &id, sizeof(id)) == sizeof(id)) {
      ids.push_back(id);
      if (ids.size() == objects) ::kill(child, SIGKILL);
    }
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    return ids;
  }
};

TEST_F(DatabaseCrash, KillNineLosesNothingThatWasStored) {
  std::set<std::uint32_t> stored;
  for (const std::size_t objects : {1U, 7U, 23U, 40U}) {
    const std::vector<std::uint32_t> ids = writeAndKill(objects);
    ASSERT_GE(ids.size(), objects);
    stored.insert(ids.begin(), ids.end());
    const auto database = openOrFail(file());
    ASSERT_NE(database, nullptr);
    EXPECT_EQ(askSqlite(file(), "PRAGMA integrity_check"), "ok");
    std::set<std::uint32_t> found;
    const std::vector<ObjectRecord> objects_now = *database->objects();
    for (const ObjectRecord& object : objects_now) {
      found.insert(object.id.value);
      EXPECT_EQ(object.views, 1);
    }
    EXPECT_TRUE(std::ranges::includes(found, stored));
    EXPECT_LE(found.size(), stored.size() + 4);  // at most the one that was not yet reported, per kill
  }
}

}  // namespace
}  // namespace scantrove
