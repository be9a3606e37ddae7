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

/// A bridge with its worker; `arrived` records its signals in order.
struct RecordedBridge {
  RecordedBridge() : bridge(ScriptedWorker::factory(worker)) {
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
  RecordedBridge recorded;
  recorded.worker->report(snapshotOf(1));
  recorded.worker->report(snapshotOf(2));
  ScanSnapshot third = snapshotOf(3);
  third.changed_bricks.push_back({Eigen::Vector3i(1, 2, 3), 7, {{0.1F, 0.2F, 0.3F, FragmentId{4}}}});
  recorded.worker->report(std::move(third));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !recorded.arrived.empty(); }, 2000));
  EXPECT_THAT(recorded.arrived, ElementsAre("frame 3"));
  ASSERT_EQ(recorded.last->changed_bricks.size(), 1U);
  EXPECT_EQ(recorded.last->changed_bricks[0].points[0].fragment, FragmentId{4});
}

TEST(ScanBridge, DeliversAllEventsInOrder) {
  RecordedBridge recorded;
  recorded.worker->report(PreparingDevice{});
  for (int i = 1; i <= 5; ++i) recorded.worker->report(ObjectAdded{ObjectId{1}, "Obj_" + std::to_string(i)});
  recorded.worker->report(ScanFailed{Error{"The disk is full.", "Make room."}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return recorded.arrived.size() >= 7; }, 2000));
  EXPECT_THAT(recorded.arrived,
              ElementsAre("preparing", "added Obj_1", "added Obj_2", "added Obj_3", "added Obj_4",
                          "added Obj_5", "failed The disk is full. Make room."));
}

TEST(ScanBridge, DeliversNothingOfThePreviousScan_AfterAStart) {
  RecordedBridge recorded;
  recorded.worker->report(snapshotOf(99));
  recorded.bridge.post(StartScan{});
  ASSERT_TRUE(QTest::qWaitFor([&] { return recorded.arrived.size() >= 2; }, 2000));
  QTest::qWait(200);
  EXPECT_THAT(recorded.arrived,
              ElementsAre("state " + std::to_string(static_cast<int>(ScanState::starting)),
                          "state " + std::to_string(static_cast<int>(ScanState::scanning))));
}

TEST(ScanBridge, DeliversEventsBeforeTheNextSnapshot) {
  RecordedBridge recorded;
  recorded.worker->report(ObjectAdded{ObjectId{1}, "Obj_1"});
  recorded.worker->report(snapshotOf(5));
  ASSERT_TRUE(QTest::qWaitFor([&] { return recorded.arrived.size() >= 2; }, 2000));
  EXPECT_THAT(recorded.arrived, ElementsAre("added Obj_1", "frame 5"));
}

// A producer on its own thread without pauses, mainly for the thread sanitizer.
TEST(ScanBridge, DeliversEverythingFromAnotherThread) {
  RecordedBridge recorded;
  constexpr int kFrames = 3000;
  std::set<int> bricks;
  int previous = -1;
  bool ordered = true;
  QObject::connect(&recorded.bridge, &ScanBridge::snapshotArrived,
                   [&](const std::shared_ptr<const ScanSnapshot>& snapshot) {
                     ordered = ordered && snapshot->frame_index > previous;
                     previous = snapshot->frame_index;
                     for (const CloudBrick& brick : snapshot->changed_bricks)
                       bricks.insert(brick.position.x());
                   });
  std::thread producer([worker = recorded.worker] {
    ScanSnapshot next;
    for (int frame = 0; frame < kFrames; ++frame) {
      // As in the worker, bricks of an uncollected snapshot go into the next one.
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
  EXPECT_EQ(std::count_if(recorded.arrived.begin(), recorded.arrived.end(),
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
