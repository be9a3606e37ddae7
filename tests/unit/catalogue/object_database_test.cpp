#include <gmock/gmock.h>

#include <set>
#include <thread>

#include "catalogue_test_support.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using ObjectDatabaseTest = CatalogueTest;

TEST_F(ObjectDatabaseTest, StartsEmpty) {
  const auto database = openOrFail(file());
  EXPECT_TRUE(database->objects()->empty());
  EXPECT_EQ(*database->views().forEachDescriptor(0, [](const StoredDescriptor&) { FAIL(); }), 0);
  EXPECT_FALSE(*database->findByName("Obj_1"));
  EXPECT_EQ(askSqlite(file(), "PRAGMA journal_mode"), "wal");
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "9");
  EXPECT_EQ(askSqlite(file(), "SELECT group_concat(name) FROM schema_migrations"),
            "001_initial.sql,002_summaries.sql,003_view_boxes.sql,004_session_cameras.sql,"
            "005_view_places.sql,006_identity.sql,007_applied_edits.sql,008_view_colors.sql,009_classes.sql");
}

TEST_F(ObjectDatabaseTest, IdentityIsAPermanentRandomUuid) {
  const std::string identity = *openOrFail(file())->identity();
  EXPECT_THAT(identity,
              testing::MatchesRegex("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}"));
  EXPECT_EQ(*openOrFail(file())->identity(), identity);
  EXPECT_NE(*openOrFail(file("other.sqlite"))->identity(), identity);
  const auto reader = ObjectDatabase::openToRead(file());
  ASSERT_TRUE(reader);
  EXPECT_EQ(*(*reader)->identity(), identity);
}

TEST_F(ObjectDatabaseTest, AssignsAnIdentity_WhenAnOlderFileIsOpenedToWrite) {
  openOrFail(file());
  forgetClasses(file());
  for (const char* sql :
       {"DROP TABLE identity", "DROP TABLE applied_edits", "DROP TABLE view_vectors",
        "DROP INDEX descriptors_without_colors", "ALTER TABLE descriptors DROP COLUMN colors",
        "DELETE FROM schema_migrations WHERE version > 5", "PRAGMA user_version = 5"})
    askSqlite(file(), sql);
  {
    const auto reader = ObjectDatabase::openToRead(file());
    ASSERT_TRUE(reader);
    EXPECT_EQ(*(*reader)->identity(), "");
  }
  const std::string identity = *openOrFail(file())->identity();
  EXPECT_EQ(identity.size(), 36U);
  EXPECT_EQ(*openOrFail(file())->identity(), identity);
}

TEST_F(ObjectDatabaseTest, NamesTheFile_WhenTheIdentityIsMissing) {
  openOrFail(file());
  askSqlite(file(), "DELETE FROM identity");
  const Result<std::string> identity = openOrFail(file())->identity();
  ASSERT_FALSE(identity);
  EXPECT_THAT(identity.error().message(), testing::HasSubstr(file()));
}

TEST_F(ObjectDatabaseTest, HasScanOf_IsTrue_WithinTenMinutesOfItsStart) {
  const auto database = openOrFail(file());
  ASSERT_TRUE(database->sessions().begin("kitchen"));
  askSqlite(file(), "UPDATE sessions SET started = '2026-03-01T10:05:00.000Z'");
  EXPECT_TRUE(*database->sessions().hasScanOf("2026-03-01T10:00:00.000Z"));
  EXPECT_TRUE(*database->sessions().hasScanOf("2026-03-01T10:14:59.000Z"));
  EXPECT_FALSE(*database->sessions().hasScanOf("2026-03-01T10:15:01.000Z"));
  EXPECT_FALSE(*database->sessions().hasScanOf("2026-03-02T10:05:00.000Z"));
  EXPECT_FALSE(*database->sessions().hasScanOf(""));
  EXPECT_FALSE(*database->sessions().hasScanOf("yesterday"));
}

TEST_F(ObjectDatabaseTest, StoresTheCameraOfASession) {
  const auto database = openOrFail(file());
  const Intrinsics K{500, 501, 320, 240, 640, 480};
  const std::int64_t with = *database->sessions().begin("desk", K),
                     without = *database->sessions().begin("desk");
  const auto cameras = database->sessions().cameras();
  ASSERT_TRUE(cameras);
  EXPECT_EQ(cameras->at(with), K);
  EXPECT_FALSE(cameras->contains(without));
}

TEST_F(ObjectDatabaseTest, ReadsBackEqual_WhenReopened) {
  std::int64_t session = 0;
  {
    const auto database = openOrFail(file());
    session = *database->sessions().begin("kitchen");
    ObjectView first = randomView(0), second = randomView(1, {200, 150});
    first.session = second.session = session;
    const ObjectRecord object = *database->addObject(first);
    EXPECT_EQ(object.name, "Obj_1");
    EXPECT_EQ(object.views, 1);
    second.object = object.id;
    EXPECT_GT(*database->addView(second), 0);
    EXPECT_TRUE(database->rename(object.id, "  blue mug \xC3\xA4 "));
    EXPECT_TRUE(database->setConfirmed({&object.id, 1}, true));
    EXPECT_TRUE(database->sessions().end(session));
  }
  const auto database = openOrFail(file());
  const std::vector<ObjectRecord> objects = *database->objects();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].name, "blue mug \xC3\xA4");
  EXPECT_TRUE(objects[0].confirmed);
  EXPECT_EQ(objects[0].size_m, randomView(0).size_m);
  EXPECT_EQ(objects[0].views, 2);
  EXPECT_EQ(objects[0].first_session, session);
  EXPECT_EQ(objects[0].first_session_name, "kitchen");
  EXPECT_THAT(objects[0].created, testing::MatchesRegex("20..-..-..T..:..:..\\....Z"));
  EXPECT_EQ(*database->findByName("blue mug \xC3\xA4"), objects[0].id);

  const std::vector<ObjectView> views = *database->views().of(objects[0].id);
  ASSERT_EQ(views.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const ObjectView expected = randomView(i, i == 0 ? cv::Size(31, 17) : cv::Size(200, 150));
    const ObjectView& view = views[static_cast<std::size_t>(i)];
    EXPECT_TRUE(sameImage(view.color, expected.color));
    EXPECT_TRUE(sameImage(view.mask, expected.mask));
    EXPECT_TRUE(sameImage(view.depth_mm, expected.depth_mm));
    EXPECT_EQ(view.T_world_camera.matrix(), expected.T_world_camera.matrix());
    EXPECT_EQ(view.direction, expected.direction);
    EXPECT_EQ(view.frame_index, i);
    EXPECT_EQ(view.box_px, cv::Rect(i, 20, 40, 30));
    EXPECT_EQ(view.frame_px, cv::Size(640, 480));
    EXPECT_EQ(view.session, session);
    EXPECT_EQ(view.object, objects[0].id);
  }
  EXPECT_EQ(database->views().picture(objects[0].id)->size(),
            cv::Size(128, 96));  // of the view with more object pixels
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sessions WHERE ended IS NOT NULL"), "1");
}

TEST_F(ObjectDatabaseTest, StoresAView_WithoutItsBox) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(0);
  view.box_px = {};
  view.frame_px = {};
  const ObjectRecord object = *database->addObject(view);
  EXPECT_TRUE(database->views().of(object.id)->front().frame_px.empty());
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM views WHERE box_x IS NULL AND frame_height IS NULL"),
            "1");
}

TEST_F(ObjectDatabaseTest, StoresAView_WithoutColor) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(3);
  view.color = cv::Mat();
  const ObjectRecord object = *database->addObject(view);
  const std::vector<ObjectView> views = *database->views().of(object.id);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_TRUE(views[0].color.empty());
  EXPECT_TRUE(sameImage(views[0].mask, view.mask));
  EXPECT_TRUE(database->views().picture(object.id)->empty());
}

TEST_F(ObjectDatabaseTest, NeverReusesANumber) {
  const auto database = openOrFail(file());
  const auto add = [&] { return *database->addObject(randomView(0)); };
  const ObjectRecord one = add(), two = add();
  EXPECT_EQ(two.name, "Obj_2");
  EXPECT_TRUE(database->remove({&two.id, 1}));
  EXPECT_EQ(add().name, "Obj_3");
  EXPECT_TRUE(database->rename(one.id, "Obj_5"));
  EXPECT_EQ(add().name, "Obj_4");
  EXPECT_EQ(add().name, "Obj_6");
  EXPECT_TRUE(database->remove({&one.id, 1}));  // hidden, it keeps Obj_5
  EXPECT_EQ(add().name, "Obj_7");
}

TEST_F(ObjectDatabaseTest, RefusesTakenAndEmptyNames) {
  const auto database = openOrFail(file());
  const ObjectRecord one = *database->addObject(randomView(0));
  const ObjectRecord two = *database->addObject(randomView(1));
  const Result<void> taken = database->rename(two.id, "Obj_1");
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message(), HasSubstr("Obj_1"));
  EXPECT_THAT(taken.error().message(), HasSubstr(file()));
  EXPECT_FALSE(database->rename(two.id, "  "));
  EXPECT_TRUE(database->rename(two.id, "Obj_2"));
  EXPECT_FALSE(database->rename(ObjectId{99}, "x"));
  EXPECT_EQ(database->object(two.id)->name, "Obj_2");
  EXPECT_TRUE(database->remove({&one.id, 1}));
  EXPECT_TRUE(database->rename(two.id, "Obj_1"));  // the name of a hidden object is free
  EXPECT_TRUE(database->restore({&one.id, 1}));
  EXPECT_EQ(database->object(one.id)->name, "Obj_1 (2)");
}

TEST_F(ObjectDatabaseTest, StoresWhoGaveTheName) {
  const auto database = openOrFail(file());
  const ObjectId id = database->addObject(randomView(0))->id;
  EXPECT_EQ(database->object(id)->named_by, NamedBy::program);
  EXPECT_TRUE(database->rename(id, "Obj_7"));
  EXPECT_EQ(database->object(id)->named_by, NamedBy::user);
  EXPECT_TRUE(database->rename(id, "Obj_1", NamedBy::program));
  EXPECT_EQ(database->object(id)->named_by, NamedBy::program);
  EXPECT_TRUE(database->rename(id, "Obj_1"));  // the user typed the generated name
  EXPECT_EQ(openOrFail(file())->object(id)->named_by, NamedBy::user);
}

TEST_F(ObjectDatabaseTest, RefusesInvalidNames) {
  const auto database = openOrFail(file());
  const ObjectId id = database->addObject(randomView(0))->id;
  const auto messageOf = [&](const std::string& name) {
    const Result<void> renamed = database->rename(id, name);
    return renamed ? "(renamed)" : renamed.error().message();
  };
  EXPECT_THAT(messageOf("two\nlines"), HasSubstr("control characters"));
  EXPECT_THAT(messageOf("a\x1b[31mred"), HasSubstr("control characters"));
  EXPECT_THAT(messageOf("a\xE2\x80\xA8z"), HasSubstr("control characters"));  // a line separator
  EXPECT_THAT(messageOf("\xff\xfe"), HasSubstr("UTF-8"));
  EXPECT_THAT(messageOf(std::string(201, 'x')), AllOf(HasSubstr("201"), HasSubstr("200")));
  EXPECT_THAT(messageOf("1"), HasSubstr("an object's id"));
  EXPECT_THAT(messageOf(" 42 "), HasSubstr("'42'"));
  EXPECT_EQ(database->object(id)->name, "Obj_1");
  std::string long_name;
  for (int i = 0; i < 200; ++i) long_name += "\xF0\x9F\x8D\xB5";  // a cup, two UTF-16 units
  for (const std::string& name :
       {long_name, std::string("4 mugs"), std::string("-1"), std::string("mug's; --")}) {
    EXPECT_EQ(messageOf(name), "(renamed)") << name;
    EXPECT_EQ(database->object(id)->name, name);
  }
}

TEST_F(ObjectDatabaseTest, ChangesNothing_WhenSessionOrObjectIsUnknown) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(0);
  view.session = 77;
  EXPECT_FALSE(database->addObject(view));
  EXPECT_FALSE(database->sessions().end(77));
  view.session = 0;
  view.object = ObjectId{5};
  EXPECT_FALSE(database->addView(view));
  EXPECT_TRUE(database->objects()->empty());
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM events"), "0");
  EXPECT_EQ(database->addObject(randomView(0))->name, "Obj_1");
}

TEST_F(ObjectDatabaseTest, StoresAllObjects_WhenSeveralConnectionsWrite) {
  constexpr int kThreads = 3, kEach = 15;
  const QtMainThread qt;
  std::vector<std::jthread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t] {
      const auto database = openOrFail(file());  // the first thread creates it
      for (int i = 0; i < kEach; ++i) {
        const Result<ObjectRecord> added = database->addObject(randomView(t * 100 + i));
        EXPECT_TRUE(added) << added.error().message();
      }
    });
  }
  threads.clear();
  std::set<std::string> names;
  const std::vector<ObjectRecord> objects = *openOrFail(file())->objects();
  for (const ObjectRecord& object : objects) names.insert(object.name);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kThreads * kEach));
  EXPECT_TRUE(names.contains("Obj_" + std::to_string(kThreads * kEach)));
}

TEST_F(ObjectDatabaseTest, ReadsChangesOfOtherConnections) {
  const auto window = openOrFail(file()), worker = openOrFail(file());
  const ObjectId id = worker->addObject(randomView(0))->id;
  EXPECT_EQ(window->object(id)->name, "Obj_1");
  EXPECT_TRUE(window->rename(id, "mug"));
  EXPECT_EQ(worker->object(id)->name, "mug");
}

}  // namespace
}  // namespace scantrove::test
