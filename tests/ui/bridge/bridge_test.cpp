#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QTest>
#include <atomic>
#include <set>
#include <thread>

#include "tests/ui/scripted_session.h"
#include "ui/bridge/session_bridge.h"

namespace scantrove {
namespace {

using test::ScriptedSession;
using testing::ElementsAre;

ScanSnapshot snapshotOf(int frame) {
  ScanSnapshot snapshot;
  snapshot.state = ScanState::scanning;
  snapshot.frame_index = frame;
  return snapshot;
}

/// The bridge, the session behind it, and what came out of it, in order.
struct Station {
  Station()
      : bridge([this](SessionPort::Listener listener) {
          auto made = std::make_unique<ScriptedSession>(std::move(listener));
          session = made.get();
          return made;
        }) {
    QObject::connect(&bridge, &SessionBridge::snapshotArrived,
                     [this](const std::shared_ptr<const ScanSnapshot>& s) {
                       news.push_back("frame " + std::to_string(s->frame_index));
                       last = s;
                     });
    QObject::connect(&bridge, &SessionBridge::stateChanged, [this](ScanState state) {
      news.push_back("state " + std::to_string(static_cast<int>(state)));
    });
    QObject::connect(&bridge, &SessionBridge::preparingDevice, [this] { news.push_back("preparing"); });
    QObject::connect(&bridge, &SessionBridge::objectAdded, [this](ObjectId, const QString& name) {
      news.push_back("added " + name.toStdString());
    });
    QObject::connect(&bridge, &SessionBridge::scanFailed,
                     [this](const QString& text) { news.push_back("failed " + text.toStdString()); });
  }

  ScriptedSession* session = nullptr;
  std::vector<std::string> news;
  std::shared_ptr<const ScanSnapshot> last;
  SessionBridge bridge;
};

TEST(SessionBridge, DeliversTheNewestSnapshotOnly) {
  Station station;
  station.session->post(snapshotOf(1));
  station.session->post(snapshotOf(2));
  ScanSnapshot third = snapshotOf(3);
  third.changed_bricks.push_back({Eigen::Vector3i(1, 2, 3), 7, {{0.1F, 0.2F, 0.3F, FragmentId{4}}}});
  station.session->post(std::move(third));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !station.news.empty(); }, 2000));
  EXPECT_THAT(station.news, ElementsAre("frame 3"));
  ASSERT_EQ(station.last->changed_bricks.size(), 1U);
  EXPECT_EQ(station.last->changed_bricks[0].points[0].fragment, FragmentId{4});
}

TEST(SessionBridge, LosesNoEventAndKeepsTheirOrder) {
  Station station;
  station.session->post(PreparingDevice{});
  for (int i = 1; i <= 5; ++i) station.session->post(ObjectAdded{ObjectId{1}, "Obj_" + std::to_string(i)});
  station.session->post(ScanFailed{Error{"The disk is full.", "Make room."}});
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.news.size() >= 7; }, 2000));
  EXPECT_THAT(station.news, ElementsAre("preparing", "added Obj_1", "added Obj_2", "added Obj_3",
                                        "added Obj_4", "added Obj_5", "failed The disk is full. Make room."));
}

TEST(SessionBridge, NothingOfTheScanBeforeComesAfterStarting) {
  Station station;
  station.session->post(snapshotOf(99));
  station.bridge.start({});
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.news.size() >= 2; }, 2000));
  QTest::qWait(200);
  EXPECT_THAT(station.news, ElementsAre("state " + std::to_string(static_cast<int>(ScanState::starting)),
                                        "state " + std::to_string(static_cast<int>(ScanState::scanning))));
}

TEST(SessionBridge, EventsComeBeforeTheSnapshotThatFollowedThem) {
  Station station;
  station.session->post(ObjectAdded{ObjectId{1}, "Obj_1"});
  station.session->post(snapshotOf(5));
  ASSERT_TRUE(QTest::qWaitFor([&] { return station.news.size() >= 2; }, 2000));
  EXPECT_THAT(station.news, ElementsAre("added Obj_1", "frame 5"));
}

/// A producer on its own thread, as fast as it can; for the thread sanitizer above all.
TEST(SessionBridge, CarriesEverythingOverFromAnotherThread) {
  Station station;
  constexpr int kFrames = 3000;
  std::set<int> bricks;
  int previous = -1;
  bool ordered = true;
  QObject::connect(&station.bridge, &SessionBridge::snapshotArrived,
                   [&](const std::shared_ptr<const ScanSnapshot>& snapshot) {
                     ordered = ordered && snapshot->frame_index > previous;
                     previous = snapshot->frame_index;
                     for (const CloudBrick& brick : snapshot->changed_bricks)
                       bricks.insert(brick.position.x());
                   });
  std::thread producer([session = station.session] {
    ScanSnapshot next;
    for (int frame = 0; frame < kFrames; ++frame) {
      // As the worker does: what was not collected is carried over.
      if (session->snapshots().empty()) next.changed_bricks.clear();
      next.frame_index = frame;
      next.changed_bricks.push_back({Eigen::Vector3i(frame, 0, 0), 1, {}});
      if (frame % 100 == 0) session->post(ObjectAdded{ObjectId{1}, std::to_string(frame)});
      session->post(next);
      if (frame % 64 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  producer.join();
  ASSERT_TRUE(QTest::qWaitFor([&] { return previous == kFrames - 1; }, 5000));
  EXPECT_TRUE(ordered);
  EXPECT_EQ(std::count_if(station.news.begin(), station.news.end(),
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
