#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QTest>
#include <atomic>
#include <set>
#include <thread>

#include "tests/ui/scripted_worker.h"
#include "ui/bridge/scan_bridge.h"

namespace scantrove {
namespace {

using test::ScriptedWorker;
using testing::ElementsAre;

ScanSnapshot snapshotOf(int frame) {
  ScanSnapshot snapshot;
  snapshot.state = ScanState::scanning;
  snapshot.frame_index = frame;
  return snapshot;
}

/// The bridge, the worker behind it, and what came out of it, in order.
struct Station {
  Station() : bridge(ScriptedWorker::factory(worker)) {
    QObject::connect(&bridge, &ScanBridge::snapshotArrived,
                     [this](const std::shared_ptr<const ScanSnapshot>& s) {
                       arrived.push_back("frame " + std::to_string(s->frame_index));
                       last = s;
                     });
    bridge.on<StateChanged>(&bridge, [this](StateChanged changed) {
      arrived.push_back("state " + std::to_string(static_cast<int>(changed.state)));
    });
    bridge.on<PreparingDevice>(&bridge, [this] { arrived.push_back("preparing"); });
    bridge.on<ObjectAdded>(&bridge,
                           [this](const ObjectAdded& added) { arrived.push_back("added " + added.name); });
    bridge.on<ScanFailed>(
        &bridge, [this](const ScanFailed& failed) { arrived.push_back("failed " + failed.error.message()); });
  }

  ScriptedWorker* worker = nullptr;
  std::vector<std::string> arrived;
  std::shared_ptr<const ScanSnapshot> last;
  ScanBridge bridge;
};

TEST(ScanBridge, DeliversTheNewestSnapshotOnly) {
  Station station;
  station.worker->report(snapshotOf(1));
  station.worker->report(snapshotOf(2));
  ScanSnapshot third = snapshotOf(3);
  third.changed_bricks.push_back({Eigen::Vector3i(1, 2, 3), 7, {{0.1F, 0.2F, 0.3F, FragmentId{4}}}});
  station.worker->report(std::move(third));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !station.arrived.empty(); }, 2000));
  EXPECT_THAT(station.arrived, ElementsAre("frame 3"));
  ASSERT_EQ(station.last->changed_bricks.size(), 1U);
  EXPECT_EQ(station.last->changed_bricks[0].points[0].fragment, FragmentId{4});
}

TEST(ScanBridge, LosesNoEventAndKeepsTheirOrder) {
  Station station;
  station.worker->report(PreparingDevice{});
  for (int i = 1; i <= 5; ++i) station.worker->report(ObjectAdded{ObjectId{1}, "Obj_" + std::to_string(i)});
  station.worker->report(ScanFailed{Error{"The disk is full.", "Make room."}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.arrived.size() >= 7; }, 2000));
  EXPECT_THAT(station.arrived,
              ElementsAre("preparing", "added Obj_1", "added Obj_2", "added Obj_3", "added Obj_4",
                          "added Obj_5", "failed The disk is full. Make room."));
}

TEST(ScanBridge, NothingOfTheScanBeforeComesAfterStarting) {
  Station station;
  station.worker->report(snapshotOf(99));
  station.bridge.post(StartScan{});
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.arrived.size() >= 2; }, 2000));
  QTest::qWait(200);
  EXPECT_THAT(station.arrived, ElementsAre("state " + std::to_string(static_cast<int>(ScanState::starting)),
                                           "state " + std::to_string(static_cast<int>(ScanState::scanning))));
}

TEST(ScanBridge, EventsComeBeforeTheSnapshotThatFollowedThem) {
  Station station;
  station.worker->report(ObjectAdded{ObjectId{1}, "Obj_1"});
  station.worker->report(snapshotOf(5));
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.arrived.size() >= 2; }, 2000));
  EXPECT_THAT(station.arrived, ElementsAre("added Obj_1", "frame 5"));
}

/// A producer on its own thread, as fast as it can; for the thread sanitizer above all.
TEST(ScanBridge, CarriesEverythingOverFromAnotherThread) {
  Station station;
  constexpr int kFrames = 3000;
  std::set<int> bricks;
  int previous = -1;
  bool ordered = true;
  QObject::connect(&station.bridge, &ScanBridge::snapshotArrived,
                   [&](const std::shared_ptr<const ScanSnapshot>& snapshot) {
                     ordered = ordered && snapshot->frame_index > previous;
                     previous = snapshot->frame_index;
                     for (const CloudBrick& brick : snapshot->changed_bricks)
                       bricks.insert(brick.position.x());
                   });
  std::thread producer([worker = station.worker] {
    ScanSnapshot next;
    for (int frame = 0; frame < kFrames; ++frame) {
      // As the worker does: what was not collected is carried over.
      if (worker->snapshots().empty()) next.changed_bricks.clear();
      next.frame_index = frame;
      next.changed_bricks.push_back({Eigen::Vector3i(frame, 0, 0), 1, {}});
      if (frame % 100 == 0) worker->report(ObjectAdded{ObjectId{1}, std::to_string(frame)});
      worker->report(next);
      if (frame % 64 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  producer.join();
  ASSERT_TRUE(QTest::qWaitFor([&] { return previous == kFrames - 1; }, 5000));
  EXPECT_TRUE(ordered);
  EXPECT_EQ(std::count_if(station.arrived.begin(), station.arrived.end(),
                          [](const std::string& text) { return text.starts_with("added"); }),
            kFrames / 100);
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  QCoreApplication application(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
