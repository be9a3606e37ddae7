// A scan while the catalogue is slow, locked, broken or edited.
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/base/urgent_end.h"
#include "tests/pipeline/collection/object_collector_fixture.h"
#include "tests/support/other_program.h"

namespace scantrove {
namespace {

using test::OtherProgram;
using test::TableItem;
using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr const char* kLock = "BEGIN IMMEDIATE";

class SlowCatalogueTest : public test::ObjectCollectorFixture {
 protected:
  /// Drains events until `condition` holds for all of them; false: not within a minute.
  template <class Condition>
  bool awaitEvents(FrameObjects& all, Condition&& condition) {
    for (int i = 0; i < 6000 && !condition(all); ++i) {
      std::this_thread::sleep_for(10ms);
      addEvents(all);
    }
    return condition(all);
  }

  /// The owner of each view in the order of storing, and the objects' data.
  static std::string contents(const std::string& file) {
    OtherProgram reader(file);
    return reader.ask(
               "SELECT group_concat(o.id || ' ' || o.name || ' ' || o.hidden || ' ' || "
               "coalesce(o.merged_into, '')"
               " || ' ' || o.size_x_m, ', ') FROM (SELECT * FROM objects ORDER BY id) o") +
           '\n' +
           reader.ask(
               "SELECT group_concat(v.id || ' ' || v.object || ' ' || v.first_object || ' ' || v.frame_index"
               " || ' ' || length(v.color), ', ') FROM (SELECT * FROM views ORDER BY id) v");
  }

  /// A scan with an object that has two entries for a while.
  void scanTable(const std::function<void(int frame)>& between = [](int) {}) {
    int frame = 0;
    const auto show = [&](const std::vector<TableItem>& items, double degrees) {
      between(frame++);
      static_cast<void>(showFrame(items, degrees));
    };
    for (int i = 0; i < 20; ++i) show({mug_, box_}, 0);
    for (int i = 0; i < 20; ++i) show({mug_, box_, cup_}, 3 * i);
    collector_->joinRegions(box_.region, cup_.region);
    for (int i = 0; i < 20; ++i) show({mug_, box_}, 60 + 3 * i);
  }
};

TEST_F(SlowCatalogueTest, FramesDoNotWait_WhenTheCatalogueIsLocked) {
  static_cast<void>(showFrames({box_}));
  waits_ = false;
  FrameObjects all;
  {
    OtherProgram other(file());
    other.execute(kLock);
    const FrameObjects locked = showFrames({box_, mug_, cup_}, 60);
    EXPECT_TRUE(locked.added.empty() && locked.new_views.empty())
        << "nothing is reported before it is stored";
    ASSERT_EQ(locked.seen.size(), 3U);
    EXPECT_TRUE(locked.seen[0].object) << "known objects stay known";
    EXPECT_FALSE(locked.seen[1].object);
    EXPECT_EQ(locked.seen[1].name, "");
    ASSERT_TRUE(
        awaitEvents(all, [](const FrameObjects& events) { return events.catalogue_failure.has_value(); }));
    EXPECT_THAT(all.catalogue_failure->message(), AllOf(HasSubstr(file()), HasSubstr("locked")));
    all.catalogue_failure.reset();
    for (int i = 0; i < 40; ++i) {
      addEvents(all);
      std::this_thread::sleep_for(200ms);
    }
    EXPECT_FALSE(all.catalogue_failure) << "reported once, though writes are repeated";
    other.execute("ROLLBACK");
  }
  ASSERT_TRUE(awaitEvents(all, [](const FrameObjects& events) { return events.added.size() == 2; }));
  settle();
  FrameObjects now = showFrame({box_, mug_, cup_}, 60);
  EXPECT_FALSE(now.catalogue_failure);
  EXPECT_EQ(now.seen[1].object, all.added[0].id);
  EXPECT_EQ(now.seen[1].name, all.added[0].name);
  EXPECT_EQ(objects().size(), 3U);
  EXPECT_EQ(objects()[0].views, 2) << "the view of the box waited too";
}

TEST_F(SlowCatalogueTest, WaitingObjectIsFound_LikeAStoredOne) {
  waits_ = false;
  OtherProgram other(file());
  settle();
  other.execute(kLock);
  static_cast<void>(showFrames({mug_}));
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showFrame({}));
  static_cast<void>(showFrames({TableItem{mug_.seed, mug_.place, RegionId{77}}}, 30));
  other.execute("ROLLBACK");
  settle();
  FrameObjects all;
  addEvents(all);
  EXPECT_EQ(all.added.size(), 1U) << "the same object under another region";
  EXPECT_EQ(all.new_views.size(), 1U);
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2);
  EXPECT_EQ(collector_->objects().idOf(RegionId{77}), objects()[0].id);
}

TEST_F(SlowCatalogueTest, SameScanGivesTheSameCatalogue_WhenItWasLocked) {
  scanTable();
  ASSERT_TRUE(collector_->settle(60s));
  const std::string waiting_for_each = contents(file());
  for (const bool is_locked : {false, true}) {
    const std::string name = (folder_ / (is_locked ? "locked.sqlite" : "quick.sqlite")).string();
    moveIn(database_, ObjectDatabase::open(name));
    collector_.reset();
    frame_ = 0;
    waits_ = false;
    moveIn(collector_,
           ObjectCollector::create(*compute_, *database_,
                                   {.database = name, .source = "table", .retry = 20ms}, params()));
    settle();
    {
      OtherProgram other(name);
      scanTable([&](int frame) {
        if (is_locked && frame == 10) other.execute(kLock);
        if (is_locked && frame == 50) other.execute("ROLLBACK");
      });
    }
    settle();
    EXPECT_EQ(contents(name), waiting_for_each) << (is_locked ? "locked" : "quick");
  }
  EXPECT_THAT(waiting_for_each, HasSubstr("1 Obj_1")) << "the query finds views";
}

TEST_F(SlowCatalogueTest, ViewIsDropped_WhenItsObjectIsDeletedFirst) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  waits_ = false;
  FrameObjects seen;
  {
    OtherProgram other(file());
    other.execute(kLock);
    seen = showFrame({mug_}, 60);
    EXPECT_EQ(seen.seen[0].object, mug) << "it is not deleted yet";
    const QString id = QString::number(mug.value);
    other.execute("UPDATE objects SET hidden = 1 WHERE id = " + id);
    other.execute("INSERT INTO events (created, action, object) VALUES ('', 'remove', " + id + ")");
    other.execute("COMMIT");
  }
  settle();
  waits_ = true;
  addEvents(seen);
  EXPECT_TRUE(seen.new_views.empty());
  EXPECT_FALSE(seen.seen[0].object);
  for (int frame = 0; frame < 30; ++frame) EXPECT_TRUE(showFrame({mug_}, 25 * frame).added.empty());
  EXPECT_TRUE(objects().empty());
  EXPECT_EQ(test::OtherProgram(file()).ask("SELECT count(*) FROM views"), "1");
  EXPECT_TRUE(collector_->objects().list().empty());
}

TEST_F(SlowCatalogueTest, ObjectsStayTwo_WhenUsersEditThemBeforeTheirMerge) {
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  waits_ = false;
  FrameObjects seen;
  {
    OtherProgram other(file());
    other.execute(kLock);
    collector_->joinRegions(mug_.region, box_.region);
    seen = showFrame({mug_});
    for (const ObjectId object : {mug, box}) {
      const QString id = QString::number(object.value);
      other.execute("UPDATE objects SET confirmed = 1 WHERE id = " + id);
      other.execute("INSERT INTO events (created, action, object) VALUES ('', 'confirm', " + id + ")");
    }
    other.execute("COMMIT");
  }
  settle();
  addEvents(seen);
  EXPECT_TRUE(seen.merged.empty());
  EXPECT_EQ(objects().size(), 2U);
  EXPECT_TRUE(collected(mug).confirmed);
  EXPECT_TRUE(collected(box).confirmed) << "the scan has both objects again";
  EXPECT_EQ(collector_->objects().list().size(), 2U);
}

TEST_F(SlowCatalogueTest, ScanContinues_WhenTheCatalogueCannotBeRead) {
  static_cast<void>(showFrames({box_}));
  waits_ = false;
  FrameObjects all;
  {
    OtherProgram other(file());
    other.execute("ALTER TABLE events RENAME TO gone");
    all = showFrames({box_, mug_});
    ASSERT_TRUE(
        awaitEvents(all, [](const FrameObjects& events) { return events.catalogue_failure.has_value(); }));
    EXPECT_THAT(all.catalogue_failure->message(), HasSubstr("damaged"));
    EXPECT_TRUE(all.added.empty());
    other.execute("ALTER TABLE gone RENAME TO events");
  }
  EXPECT_TRUE(awaitEvents(all, [](const FrameObjects& events) { return events.added.size() == 1; }));
}

TEST_F(SlowCatalogueTest, FinishReportsObjects_ThatAreNotStored) {
  writer_.patience = 100ms;
  beginScan();
  static_cast<void>(showFrames({box_}));
  waits_ = false;
  OtherProgram other(file());
  other.execute(kLock);
  static_cast<void>(showFrames({box_, mug_, cup_}, 60));
  std::size_t stored = 0;
  const Result<void> finished = collector_->finish(
      [&](const FrameObjects& events) { stored += events.added.size() + events.new_views.size(); });
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(),
              AllOf(HasSubstr(file()), HasSubstr("has not got 2 new objects, 1 view."), HasSubstr("locked")));
  EXPECT_EQ(stored, 0U);
  ASSERT_EQ(collector_->objects().list().size(), 1U) << "as in the catalogue";
  other.execute("ROLLBACK");
  EXPECT_EQ(objects().size(), 1U);
}

// Without the urgency it would wait for an hour.
TEST_F(SlowCatalogueTest, FinishDoesNotWaitForALock_WhenItIsUrgent) {
  writer_.patience = std::chrono::hours(1);
  beginScan();
  static_cast<void>(showFrames({box_}));
  waits_ = false;
  OtherProgram other(file());
  other.execute(kLock);
  static_cast<void>(showFrames({box_, mug_}, 60));
  auto end = std::async(std::launch::async, [&] { return collector_->finish([](const FrameObjects&) {}); });
  setEndUrgent(true);
  const Result<void> finished = end.get();
  setEndUrgent(false);
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(), HasSubstr("has not got"));
}

TEST_F(SlowCatalogueTest, FinishWaitsForALock) {
  waits_ = false;
  auto other = std::make_unique<OtherProgram>(file());
  settle();
  other->execute(kLock);
  static_cast<void>(showFrames({mug_}));
  auto end = std::async(std::launch::async, [&] {
    std::size_t added = 0;
    const Result<void> finished =
        collector_->finish([&](const FrameObjects& events) { added += events.added.size(); });
    EXPECT_TRUE(finished);
    return added;
  });
  EXPECT_EQ(end.wait_for(1s), std::future_status::timeout);
  other->execute("ROLLBACK");
  EXPECT_EQ(end.get(), 1U);
  EXPECT_EQ(other->ask("SELECT count(*) FROM sessions WHERE ended IS NULL"), "0");
  ASSERT_EQ(collector_->objects().list().size(), 1U);
  EXPECT_EQ(collector_->objects().list()[0].views, 1);
}

TEST_F(SlowCatalogueTest, NewObjectsAreStored_WhenThereIsNoRoomForViews) {
  const std::size_t view = sizeof(ObjectView) + std::size_t{80 * 100 * 6};
  writer_.most_bytes = 5 * view / 2;
  writer_.room_patience = 10ms;
  beginScan();
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem fourth{8, 0, RegionId{88}};
  Candidate elsewhere = fourth.candidate();
  elsewhere.centroid_world.z() = 5;
  waits_ = false;
  {
    OtherProgram other(file());
    other.execute(kLock);
    static_cast<void>(showFrames({mug_, box_, cup_}));
    for (int i = 0; i < 20; ++i) static_cast<void>(showCandidates({elsewhere}, {fourth}));
    static_cast<void>(showFrame({mug_}, 60));  // a view without room, because two objects wait
    other.execute("ROLLBACK");
    settle();
    FrameObjects all;
    addEvents(all);
    EXPECT_EQ(all.added.size(), 2U);
    EXPECT_TRUE(all.new_views.empty());
  }
  waits_ = true;
  std::size_t added = 0;
  for (int i = 0; i < 20; ++i) added += showCandidates({elsewhere}, {fourth}).added.size();
  EXPECT_EQ(added, 1U) << "it was still a candidate";
  EXPECT_EQ(showFrame({mug_}, 60).new_views, std::vector<ObjectId>{mug}) << "the direction was still new";
  EXPECT_EQ(objects().size(), 4U);
}

/// Without a collector: tests call the writer directly.
class CatalogueWriterTest : public SlowCatalogueTest {
 protected:
  void SetUp() override {
    moveIn(person_, ObjectDatabase::open(file()));
    writer_.database = file();
    writer_.source = "test";
    moveIn(store_, CatalogueWriter::start(writer_, {}));
  }
  static ObjectView view(ObjectId object, const cv::Size& size) {
    ObjectView view;
    view.object = object;
    view.color = cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3));
    view.mask = cv::Mat(size, CV_8UC1, cv::Scalar(255));
    view.depth_mm = cv::Mat(size, CV_16UC1, cv::Scalar(1000));
    return view;
  }

  std::unique_ptr<CatalogueWriter> store_;
};

TEST_F(CatalogueWriterTest, OtherViewsAreStored_WhenOneCannotBeEncoded) {
  const ObjectId bad{1U << 31U}, good{bad.value + 1};
  ASSERT_TRUE(store_->addObject(view(bad, {1000001, 1})));  // wider than a PNG can be
  store_->addView(view(bad, {10, 10}));
  ASSERT_TRUE(store_->addObject(view(good, {10, 10})));
  const Result<void> finished = store_->finish();
  ASSERT_FALSE(finished);
  EXPECT_THAT(finished.error().message(), AllOf(HasSubstr(file()), HasSubstr("has not got 1 new object.")));
  std::vector<CatalogueEvent> events = store_->drainEvents();
  ASSERT_GE(events.size(), 3U);
  EXPECT_EQ(std::get<event::ObjectRefused>(events[0]).key, bad);
  EXPECT_EQ(std::get<event::ViewDropped>(events[1]).key, bad);
  EXPECT_EQ(std::get<event::ObjectStored>(events[2]).key, good);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(CatalogueWriterTest, FailedWritesAreRepeated) {
  ASSERT_TRUE(store_->settle(60s));
  OtherProgram other(file());
  other.execute("CREATE TRIGGER broken BEFORE INSERT ON views BEGIN SELECT RAISE(FAIL, 'broken'); END");
  const ObjectId key{1U << 31U};
  ASSERT_TRUE(store_->addObject(view(key, {10, 10})));
  store_->addView(view(key, {10, 10}));
  EXPECT_FALSE(store_->settle(300ms));
  std::vector<CatalogueEvent> events = store_->drainEvents();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(std::get<event::Failed>(events[0]).error.message(), HasSubstr("broken"));
  other.execute("DROP TRIGGER broken");
  EXPECT_TRUE(store_->settle(60s));
  ASSERT_EQ(objects().size(), 1U) << "failed attempts store nothing";
  EXPECT_EQ(objects()[0].views, 2);
  EXPECT_EQ(objects()[0].name, "Obj_1");
  EXPECT_TRUE(store_->finish());
}

TEST_F(CatalogueWriterTest, NothingIsStored_WhenTheFileIsGone) {
  ASSERT_TRUE(store_->settle(60s));
  const std::filesystem::path moved = folder_ / "moved.sqlite";
  std::filesystem::rename(file(), moved);
  const ObjectId key{1U << 31U};
  ASSERT_TRUE(store_->addObject(view(key, {10, 10})));
  EXPECT_FALSE(store_->settle(300ms));
  const std::vector<CatalogueEvent> events = store_->drainEvents();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(std::get<event::Failed>(events[0]).error.message(),
              AllOf(HasSubstr(file()), HasSubstr("moved")));
  std::filesystem::rename(moved, file());
  EXPECT_TRUE(store_->settle(60s));
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_TRUE(store_->finish());
}

TEST_F(CatalogueWriterTest, StartFails_WhenTheCatalogueCannotBeOpened) {
  writer_.database = folder_.path().string();
  const auto other = CatalogueWriter::start(writer_, {});
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message(), HasSubstr("is a folder"));
}

}  // namespace
}  // namespace scantrove
