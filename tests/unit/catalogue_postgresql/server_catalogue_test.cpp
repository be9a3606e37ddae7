// What is particular to a catalogue on a server: many writers, a lost server, notifications, copies.
#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>
#include <vector>

#include "core/catalogue/catalogue_copy.h"
#include "core/catalogue/catalogue_schema.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"
#include "server.h"
#include "tests/unit/catalogue/catalogue_test_support.h"
#include "tests/unit/catalogue/earlier_catalogue.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using namespace std::chrono_literals;

using ServerCatalogueTest = CatalogueTest;

std::string openingMessage(const std::string& database) {
  const auto opened = ObjectDatabase::open(database);
  return opened ? "(opened)" : opened.error().message();
}

/// Waits for at most half a minute.
template <class Condition>
bool becomesTrue(Condition&& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;  // which may have changed something: it is not asked again
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

ObjectView viewFor(std::uint32_t key, int seed) {
  ObjectView view = randomView(seed);
  view.object = ObjectId{key};
  return view;
}

TEST_F(ServerCatalogueTest, SaysWhatToDo_WhenItCannotBeOpened) {
  EXPECT_THAT(openingMessage(server().url("missing")),
              AllOf(HasSubstr("no database"), HasSubstr("createdb")));
  EXPECT_THAT(openingMessage("postgresql:///x?host=" + folder_.string()),
              AllOf(HasSubstr("No PostgreSQL server answers"), HasSubstr("Start the server")));
  EXPECT_THAT(openingMessage("postgresql://name.invalid/x"), HasSubstr("not known"));
}

TEST_F(ServerCatalogueTest, TakesThePasswordFromTheEnvironmentOnly) {
  const std::string database = file();
  std::string locked = database;
  locked.replace(locked.find("user=scantrove"), std::string("user=scantrove").size(), "user=locked");
  const std::string name =
      database.substr(database.find("test_"), database.find('?') - database.find("test_"));
  server().execute("GRANT ALL ON SCHEMA public TO locked", name);
  EXPECT_THAT(openingMessage(locked), AllOf(HasSubstr("asks for a password"), HasSubstr("pgpass")));
  ::setenv("PGPASSWORD", "wrong_one", 1);
  EXPECT_THAT(openingMessage(locked), AllOf(HasSubstr("refused"), Not(HasSubstr("wrong_one"))));
  ::setenv("PGPASSWORD", "secret", 1);
  EXPECT_EQ(openingMessage(locked), "(opened)");
  ::unsetenv("PGPASSWORD");
}

TEST_F(ServerCatalogueTest, RefusesUnchanged_WhenTheDatabaseIsAnotherPrograms) {
  askDatabase(file(), "CREATE TABLE bookmarks (url TEXT)");
  EXPECT_THAT(openingMessage(file()), AllOf(HasSubstr("another program"), HasSubstr("createdb")));
  EXPECT_EQ(askDatabase(file(), "SELECT count(*) FROM pg_tables WHERE schemaname = 'public'"), "1");
}

TEST_F(ServerCatalogueTest, IsCreatedOnce_WhenProgramsOpenItAtTheSameTime) {
  const std::string database = file();
  std::vector<std::thread> programs;
  std::atomic<int> opened = 0;
  for (int i = 0; i < 4; ++i)
    programs.emplace_back([&] { opened += openingMessage(database) == "(opened)" ? 1 : 0; });
  for (std::thread& program : programs) program.join();
  EXPECT_EQ(opened, 4);
  EXPECT_EQ(askDatabase(database, "SELECT version FROM scantrove_schema"), "9");
  EXPECT_EQ(askDatabase(database, "SELECT count(*) FROM schema_migrations"), "9");
  EXPECT_EQ(askDatabase(database, "SELECT count(*) FROM identity"), "1");
}

TEST_F(ServerCatalogueTest, NamesOneObject_WhenScannersWriteAtTheSameTime) {
  const std::string database = file();
  ASSERT_NE(openOrFail(database), nullptr);
  constexpr int kScanners = 4, kObjects = 10;
  std::atomic<int> added = 0, named = 0;
  std::vector<std::thread> scanners;
  for (int scanner = 0; scanner < kScanners; ++scanner) {
    scanners.emplace_back([&, scanner] {
      const auto own = openOrFail(database);
      for (int i = 0; i < kObjects; ++i) {
        const auto object = own->addObject(randomView(scanner * kObjects + i));
        added += object ? 1 : 0;
        if (object) named += own->rename(object->id, "mug " + std::to_string(i)) ? 1 : 0;
      }
    });
  }
  // Events are committed in the order of their ids: a reader misses none.
  const auto reader = openOrFail(database);
  std::int64_t last = 0;
  int additions = 0;
  const auto read = [&] {
    const CatalogueChanges changes = *reader->changesAfter(last);
    last = changes.last_event;
    for (const CatalogueChange& change : changes.changes)
      additions += change.kind == CatalogueChange::Kind::added ? 1 : 0;
    return additions == kScanners * kObjects;
  };
  EXPECT_TRUE(becomesTrue(read));
  for (std::thread& scanner : scanners) scanner.join();
  EXPECT_EQ(added, kScanners * kObjects);
  EXPECT_EQ(named, kObjects) << "each name once";
  std::set<std::string> names;
  const auto objects = reader->objects();
  for (const ObjectRecord& object : *objects) names.insert(object.name);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kScanners * kObjects));
}

TEST_F(ServerCatalogueTest, RunsATransactionAgain_AfterAConflict) {
  const auto connection = DatabaseConnection::open(file());
  ASSERT_TRUE(connection);
  int runs = 0;
  const auto work = [&]() -> Result<int> {
    if (++runs < 3) {
      SCANTROVE_TRY(
          (*connection)->execute("DO $$ BEGIN RAISE EXCEPTION 'conflict' USING ERRCODE = '40001'; END $$"));
    }
    return runs;
  };
  EXPECT_EQ(inTransaction(**connection, work).value_or(0), 3);
  runs = -100;
  EXPECT_FALSE(inTransaction(**connection, work)) << "it does not try for ever";
}

TEST_F(ServerCatalogueTest, KeepsAllThatWasCommitted_WhenTheServerIsKilled) {
  const auto database = openOrFail(file());
  ASSERT_NE(database, nullptr);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(database->addObject(randomView(i)));
  server().kill();
  const auto refused = database->addObject(randomView(5));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr(file()));
  server().start();
  EXPECT_TRUE(becomesTrue([&] { return database->addObject(randomView(6)).has_value(); }))
      << "the same connection is made again";
  EXPECT_EQ(database->objects()->size(), 6U);
}

TEST_F(ServerCatalogueTest, WriterStoresEachObjectOnce_WhenTheServerWasAway) {
  const std::string database = file();
  const auto reader = openOrFail(database);
  ASSERT_NE(reader, nullptr);
  CatalogueWriter::Options options;
  options.database = database;
  options.retry = 50ms;
  auto writer = CatalogueWriter::start(options, {});
  ASSERT_TRUE(writer) << writer.error().message();
  ASSERT_TRUE((*writer)->addObject(viewFor(1U << 31U, 0)));
  ASSERT_TRUE((*writer)->settle(30s));
  static_cast<void>((*writer)->drainEvents());
  server().kill();
  ASSERT_TRUE((*writer)->addObject(viewFor((1U << 31U) + 1, 1)));
  (*writer)->addView(viewFor(1U << 31U, 2));
  int failures = 0;
  const auto drain = [&] {
    for (const CatalogueEvent& one : (*writer)->drainEvents())
      failures += std::holds_alternative<event::Failed>(one) ? 1 : 0;
    return failures > 0;
  };
  EXPECT_TRUE(becomesTrue(drain));
  std::this_thread::sleep_for(500ms);  // several attempts
  server().start();
  EXPECT_TRUE((*writer)->settle(60s));
  drain();
  EXPECT_EQ(failures, 1) << "it is said once";
  EXPECT_TRUE((*writer)->finish());
  ASSERT_TRUE(becomesTrue([&] { return reader->objects().has_value(); }));
  EXPECT_EQ(reader->objects()->size(), 2U);
  EXPECT_EQ(*reader->views().count(), 3);
}

TEST_F(ServerCatalogueTest, OthersLearnOfANewName_WithoutAsking) {
  const std::string database = file();
  const auto person = openOrFail(database);
  ASSERT_NE(person, nullptr);
  const ObjectId object = person->addObject(randomView(0))->id;
  CatalogueWriter::Options options;
  options.database = database;
  auto writer = CatalogueWriter::start(options, {*person->lastEvent(), 0});
  ASSERT_TRUE(writer) << writer.error().message();
  ASSERT_TRUE(person->rename(object, "mug"));
  bool is_known = false;
  EXPECT_TRUE(becomesTrue([&] {
    for (const CatalogueEvent& one : (*writer)->drainEvents()) {
      const auto* edited = std::get_if<event::Edited>(&one);
      if (edited == nullptr) continue;
      for (const ObjectRecord& record : edited->edits.records) is_known = is_known || record.name == "mug";
    }
    return is_known;
  }));
  EXPECT_TRUE((*writer)->finish());
}

/// All rows of the tables that hold a catalogue, as one number each.
std::vector<std::string> contents(const std::string& database) {
  std::vector<std::string> answers;
  for (const char* sql :
       {"SELECT uuid FROM identity", "SELECT count(*) FROM events", "SELECT max(id) FROM events",
        "SELECT count(*) FROM sessions", "SELECT name FROM classes WHERE id = 1",
        "SELECT after_json FROM events WHERE action = 'rename'",
        "SELECT merged_into FROM objects WHERE id = 3", "SELECT best_view FROM objects WHERE id = 1",
        "SELECT attributes FROM objects WHERE id = 1", "SELECT count(*) FROM pictures",
        "SELECT max(token) FROM applied_edits"})
    answers.push_back(askDatabase(database, sql));
  return answers;
}

std::vector<QByteArray> viewBytes(const std::string& database) {
  const auto connection = DatabaseConnection::openToRead(database);
  std::vector<QByteArray> bytes;
  for (const char* sql : {"SELECT color, mask, depth_mm FROM views ORDER BY id",
                          "SELECT fine, colors, fine FROM descriptors ORDER BY view"}) {
    auto rows = (*connection)->execute(sql);
    EXPECT_TRUE(rows);
    while (rows && rows->next()) {
      for (int i = 0; i < 3; ++i) bytes.push_back(rows->value(i).toByteArray());
    }
  }
  return bytes;
}

TEST_F(ServerCatalogueTest, CopyIsEqual_FromFileToServerAndBack) {
  const std::string original = folder_ / "original.sqlite", back = folder_ / "back.sqlite";
  {
    const auto database = openOrFail(original);
    const std::int64_t session = *database->sessions().begin("a scan");
    std::vector<ObjectId> ids;
    for (int i = 0; i < 70; ++i) {  // more than a page
      ObjectView view = randomView(i);
      view.session = session;
      if (i == 5) view.depth_mm.release();
      ids.push_back(database->addObject(view)->id);
    }
    ASSERT_TRUE(database->rename(ids[0], "it's a \\ \"mug\" ?"));
    const ClassId mugs = *database->classes().add({.name = "mug"});
    ASSERT_TRUE(database->classes().classify(std::array{ids[0]}, mugs));
    ASSERT_TRUE(database->merge(std::array{ids[0], ids[2]}));
    ASSERT_TRUE(database->applyOnce("token", [] { return Result<std::string>("done"); }));
  }
  const Result<CatalogueCopy> there = copyCatalogue(original, file());
  ASSERT_TRUE(there) << there.error().message();
  EXPECT_EQ(there->objects, 69);
  EXPECT_EQ(there->views, 70);
  EXPECT_EQ(there->classes, 1);
  ASSERT_TRUE(copyCatalogue(file(), back));
  for (const std::string& copy : {file(), back}) {
    EXPECT_EQ(contents(copy), contents(original)) << copy;
    EXPECT_EQ(viewBytes(copy), viewBytes(original)) << copy;
    EXPECT_EQ(openOrFail(copy)->model()->objects(), openOrFail(original)->model()->objects()) << copy;
  }
  for (const std::string& copy : {file(), back}) {
    const Result<ObjectRecord> next = openOrFail(copy)->addObject(randomView(1));
    ASSERT_TRUE(next) << next.error().message();
    EXPECT_EQ(next->id.value, 71U) << "ids go on";
    EXPECT_EQ(next->name, "Obj_71");
  }
}

TEST_F(ServerCatalogueTest, CopyIsEqual_WhenAnEarlierVersionWroteTheFile) {
  for (int version = 1; version <= static_cast<int>(schema::catalogueSteps().size()); ++version) {
    SCOPED_TRACE("version " + std::to_string(version));
    const std::string name = "version" + std::to_string(version);
    const std::string original = folder_ / (name + ".sqlite"), back = folder_ / (name + "_back.sqlite");
    EarlierCatalogue::write(original, version);
    {
      const auto database = openOrFail(original);
      ASSERT_NE(database, nullptr);
      ASSERT_TRUE(database->views().forEachDescriptor(0, [](const StoredDescriptor&) {}));
    }
    const Result<CatalogueCopy> there = copyCatalogue(original, file(name));
    ASSERT_TRUE(there) << there.error().message();
    ASSERT_TRUE(copyCatalogue(file(name), back));
    const auto rows = storedRows(original);
    EXPECT_EQ(rows.at("views").size(), static_cast<std::size_t>(EarlierCatalogue::kObjects));
    for (const std::string& copy : {file(name), back}) {
      const auto copied = storedRows(copy);
      expectKept(rows, copied);  // names what differs
      EXPECT_TRUE(copied == rows) << copy;
    }
  }
}

TEST_F(ServerCatalogueTest, CopyRefuses_WhenTheTargetHoldsObjects) {
  const std::string original = folder_ / "original.sqlite";
  ASSERT_TRUE(openOrFail(original)->addObject(randomView(0)));
  ASSERT_TRUE(openOrFail(file())->addObject(randomView(1)));
  const Result<CatalogueCopy> copied = copyCatalogue(original, file());
  ASSERT_FALSE(copied);
  EXPECT_THAT(copied.error().message(), AllOf(HasSubstr("not empty"), HasSubstr(file())));
  EXPECT_EQ(openOrFail(file())->objects()->size(), 1U);
}

TEST_F(ServerCatalogueTest, CopiesNothing_WhenARowCannotBeStored) {
  const std::string original = folder_ / "original.sqlite";
  ASSERT_TRUE(openOrFail(original)->addObject(randomView(0)));
  ASSERT_NE(openOrFail(file()), nullptr);
  askDatabase(file(), "ALTER TABLE events ADD CONSTRAINT none CHECK (action <> 'add')");
  EXPECT_FALSE(copyCatalogue(original, file()));
  EXPECT_EQ(askDatabase(file(), "SELECT count(*) FROM objects"), "0");
  EXPECT_EQ(askDatabase(file(), "SELECT count(*) FROM views"), "0");
}

}  // namespace
}  // namespace scantrove::test
