#include <gmock/gmock.h>

#include <set>
#include <thread>

#include "catalog_test_support.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove {
namespace {

using test::askSqlite;
using test::CatalogTest;
using test::openOrFail;
using test::randomView;
using test::sameImage;
using testing::HasSubstr;

using ObjectDatabaseTest = CatalogTest;
const Eigen::Vector3f kSize(0.3F, 0.2F, 0.1F);

TEST_F(ObjectDatabaseTest, StartsEmpty) {
  const auto database = openOrFail(file());
  EXPECT_TRUE(database->objects()->empty());
  EXPECT_TRUE(database->viewsAfter(0)->empty());
  EXPECT_FALSE(*database->findByName("Obj_1"));
  EXPECT_EQ(askSqlite(file(), "PRAGMA journal_mode"), "wal");
  EXPECT_EQ(askSqlite(file(), "PRAGMA user_version"), "1");
  EXPECT_EQ(askSqlite(file(), "SELECT name FROM schema_migrations"), "001_initial.sql");
}

TEST_F(ObjectDatabaseTest, EverythingComesBackAfterReopening) {
  std::int64_t session = 0;
  {
    const auto database = openOrFail(file());
    session = *database->beginSession("kitchen");
    ObjectView first = randomView(0), second = randomView(1, {200, 150});
    first.session = second.session = session;
    const ObjectRecord object = *database->addObject(kSize, first);
    EXPECT_EQ(object.name, "Obj_1");
    EXPECT_EQ(object.views, 1);
    second.object = object.id;
    EXPECT_GT(*database->addView(second), 0);
    EXPECT_TRUE(database->rename(object.id, "  blue mug \xC3\xA4 "));
    EXPECT_TRUE(database->setConfirmed(object.id, true));
    EXPECT_TRUE(database->endSession(session));
  }
  const auto database = openOrFail(file());
  const std::vector<ObjectRecord> objects = *database->objects();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].name, "blue mug \xC3\xA4");
  EXPECT_TRUE(objects[0].confirmed);
  EXPECT_EQ(objects[0].size_m, kSize);
  EXPECT_EQ(objects[0].views, 2);
  EXPECT_EQ(objects[0].first_session, session);
  EXPECT_EQ(objects[0].first_session_name, "kitchen");
  EXPECT_THAT(objects[0].created, testing::MatchesRegex("20..-..-..T..:..:..\\....Z"));
  EXPECT_EQ(*database->findByName("blue mug \xC3\xA4"), objects[0].id);

  const std::vector<ObjectView> views = *database->views(objects[0].id);
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
    EXPECT_EQ(view.session, session);
    EXPECT_EQ(view.object, objects[0].id);
  }
  EXPECT_TRUE(sameImage(database->representativeView(objects[0].id)->color, randomView(1, {200, 150}).color));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM sessions WHERE ended IS NOT NULL"), "1");
}

TEST_F(ObjectDatabaseTest, DepthOnlySourcesHaveNoColour) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(3);
  view.color = cv::Mat();
  const ObjectRecord object = *database->addObject(kSize, view);
  const std::vector<ObjectView> views = *database->views(object.id);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_TRUE(views[0].color.empty());
  EXPECT_TRUE(sameImage(views[0].mask, view.mask));
  EXPECT_TRUE(database->representativeView(object.id)->color.empty());
}

TEST_F(ObjectDatabaseTest, ViewsAfterLetsADetectorCatchUp) {
  const auto database = openOrFail(file());
  const ObjectId first = database->addObject(kSize, randomView(0))->id;
  const std::int64_t seen = database->viewsAfter(0)->back().id;
  const ObjectId second = database->addObject(kSize, randomView(1))->id;
  const ObjectId third = database->addObject(kSize, randomView(2))->id;
  EXPECT_TRUE(database->remove(third));
  ObjectView more = randomView(3);
  more.object = first;
  EXPECT_TRUE(database->addView(more));
  const std::vector<ObjectView> views = *database->viewsAfter(seen);
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0].object, second);
  EXPECT_EQ(views[1].object, first);
}

TEST_F(ObjectDatabaseTest, NumbersAreGivenOnce) {
  const auto database = openOrFail(file());
  const auto add = [&] { return *database->addObject(kSize, randomView(0)); };
  const ObjectRecord one = add(), two = add();
  EXPECT_EQ(two.name, "Obj_2");
  EXPECT_TRUE(database->remove(two.id));
  EXPECT_EQ(add().name, "Obj_3");
  EXPECT_TRUE(database->rename(one.id, "Obj_5"));
  EXPECT_EQ(add().name, "Obj_4");
  EXPECT_EQ(add().name, "Obj_6");
  EXPECT_TRUE(database->remove(one.id));  // hidden it still holds Obj_5
  EXPECT_EQ(add().name, "Obj_7");
}

TEST_F(ObjectDatabaseTest, NamesAreUniqueAndNotEmpty) {
  const auto database = openOrFail(file());
  const ObjectRecord one = *database->addObject(kSize, randomView(0));
  const ObjectRecord two = *database->addObject(kSize, randomView(1));
  const Result<void> taken = database->rename(two.id, "Obj_1");
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message(), HasSubstr("Obj_1"));
  EXPECT_THAT(taken.error().message(), HasSubstr(file()));
  EXPECT_FALSE(database->rename(two.id, "  "));
  EXPECT_TRUE(database->rename(two.id, "Obj_2"));
  EXPECT_FALSE(database->rename(ObjectId{99}, "x"));
  EXPECT_EQ(database->object(two.id)->name, "Obj_2");
  EXPECT_TRUE(database->remove(one.id));
  EXPECT_TRUE(database->rename(two.id, "Obj_1"));  // the name of a hidden object is free
  EXPECT_TRUE(database->restore(one.id));
  EXPECT_EQ(database->object(one.id)->name, "Obj_1 (2)");
}

TEST_F(ObjectDatabaseTest, RemoveAndRestore) {
  const auto database = openOrFail(file());
  const ObjectId id = database->addObject(kSize, randomView(0))->id;
  EXPECT_TRUE(database->remove(id));
  EXPECT_TRUE(database->objects()->empty());
  EXPECT_FALSE(*database->resolve(id));
  const Result<ObjectRecord> removed = database->object(id);
  ASSERT_FALSE(removed);
  EXPECT_THAT(removed.error().message(), HasSubstr("deleted"));
  EXPECT_FALSE(database->remove(id));
  EXPECT_TRUE(database->restore(id));
  EXPECT_EQ(database->object(id)->views, 1);
}

TEST_F(ObjectDatabaseTest, MergeAndUnmerge) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(kSize, randomView(0))->id;
  const ObjectId b = database->addObject(kSize, randomView(1))->id;
  const ObjectId c = database->addObject(kSize, randomView(2))->id;
  EXPECT_FALSE(database->merge(a, a));
  EXPECT_TRUE(database->merge(b, a));
  EXPECT_TRUE(database->merge(c, b));
  EXPECT_EQ(database->objects()->size(), 1U);
  EXPECT_EQ(database->object(c)->views, 3);
  EXPECT_EQ(*database->resolve(a), c);
  ObjectView late = randomView(4);  // a scan that still follows `a`
  late.object = a;
  EXPECT_TRUE(database->addView(late));
  EXPECT_EQ(database->object(c)->views, 4);
  EXPECT_FALSE(database->merge(c, a));
  EXPECT_FALSE(database->unmerge(c, a));  // it was merged into b
  EXPECT_FALSE(database->restore(a));

  EXPECT_TRUE(database->unmerge(c, b));  // b comes back with what it held of a
  EXPECT_EQ(database->object(c)->views, 1);
  EXPECT_EQ(database->object(b)->views, 3);
  EXPECT_EQ(*database->resolve(a), b);
  EXPECT_TRUE(database->unmerge(b, a));
  EXPECT_EQ(database->object(a)->views, 2);
  EXPECT_EQ(database->object(b)->views, 1);
  EXPECT_TRUE(sameImage(database->views(a)->front().color, randomView(0).color));
  EXPECT_EQ(database->object(a)->name, "Obj_1");
}

TEST_F(ObjectDatabaseTest, EveryChangeIsAnEvent) {
  const auto database = openOrFail(file());
  const std::int64_t session = *database->beginSession("demo");
  ObjectView view = randomView(0);
  view.session = session;
  const ObjectId a = database->addObject(kSize, view)->id;
  const ObjectId b = database->addObject(kSize, view)->id;
  EXPECT_TRUE(database->rename(a, "mug"));
  EXPECT_TRUE(database->setConfirmed(a, true));
  EXPECT_TRUE(database->setConfirmed(a, true));  // no change, no event
  EXPECT_TRUE(database->merge(a, b));
  EXPECT_TRUE(database->unmerge(a, b));
  EXPECT_TRUE(database->remove(b));
  EXPECT_TRUE(database->restore(b));
  EXPECT_FALSE(database->rename(b, "mug"));  // failed, no event
  EXPECT_EQ(
      askSqlite(file(), "SELECT group_concat(action, ' ') FROM (SELECT action FROM events ORDER BY id)"),
      "session-begin add add-view add add-view rename confirm merge unmerge remove restore");
  EXPECT_EQ(askSqlite(file(), "SELECT before_json FROM events WHERE action = 'rename'"),
            R"({"confirmed":false,"hidden":false,"name":"Obj_1"})");
  EXPECT_EQ(askSqlite(file(), "SELECT after_json FROM events WHERE action = 'merge'"),
            R"({"confirmed":false,"hidden":true,"merged_into":1,"name":"Obj_2","views":[2]})");
}

TEST_F(ObjectDatabaseTest, UnknownSessionsAndObjectsAreRefusedWhole) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(0);
  view.session = 77;
  EXPECT_FALSE(database->addObject(kSize, view));
  EXPECT_FALSE(database->endSession(77));
  view.session = 0;
  view.object = ObjectId{5};
  EXPECT_FALSE(database->addView(view));
  EXPECT_TRUE(database->objects()->empty());
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM events"), "0");
  EXPECT_EQ(database->addObject(kSize, randomView(0))->name, "Obj_1");
}

TEST_F(ObjectDatabaseTest, SeveralConnectionsWriteAtOnce) {
  constexpr int kThreads = 3, kEach = 15;
  const test::QtMainThread qt;
  std::vector<std::jthread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t] {
      const auto database = openOrFail(file());  // also created by whoever comes first
      for (int i = 0; i < kEach; ++i) {
        const Result<ObjectRecord> added = database->addObject(kSize, randomView(t * 100 + i));
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

TEST_F(ObjectDatabaseTest, OneConnectionSeesWhatAnotherWrote) {
  const auto window = openOrFail(file()), worker = openOrFail(file());
  const ObjectId id = worker->addObject(kSize, randomView(0))->id;
  EXPECT_EQ(window->object(id)->name, "Obj_1");
  EXPECT_TRUE(window->rename(id, "mug"));
  EXPECT_EQ(worker->object(id)->name, "mug");
}

}  // namespace
}  // namespace scantrove
