#include "core/scan/scan_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>

#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Collects a session's events on the worker thread and lets a test wait for them.
class EventLog {
 public:
  void add(const ScanEvent& event) {
    const std::scoped_lock lock(mutex_);
    events_.push_back(event);
    arrived_.notify_all();
  }

  /// Waits until the session entered `state` for the `times`-th time.
  void awaitState(ScanState state, int times = 1) {
    std::unique_lock lock(mutex_);
    const bool in_time =
        arrived_.wait_for(lock, std::chrono::seconds(120), [&] { return countOf(state) >= times; });
    ASSERT_TRUE(in_time) << "state " << static_cast<int>(state) << " never came";
  }

  [[nodiscard]] std::vector<ScanState> states() {
    const std::scoped_lock lock(mutex_);
    std::vector<ScanState> states;
    for (const ScanEvent& event : events_) {
      if (const auto* changed = std::get_if<StateChanged>(&event)) states.push_back(changed->state);
    }
    return states;
  }

  [[nodiscard]] std::string failure() {
    const std::scoped_lock lock(mutex_);
    for (const ScanEvent& event : events_) {
      if (const auto* failed = std::get_if<ScanFailed>(&event)) return failed->error.message();
    }
    return {};
  }

 private:
  [[nodiscard]] int countOf(ScanState state) const {
    int count = 0;
    for (const ScanEvent& event : events_) {
      const auto* changed = std::get_if<StateChanged>(&event);
      count += changed != nullptr && changed->state == state ? 1 : 0;
    }
    return count;
  }

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<ScanEvent> events_;
};

class ScanSessionTest : public testing::Test {
 protected:
  [[nodiscard]] ScanRequest request(int frames) const {
    ScanRequest request;
    request.source = "demo";
    request.source_options.frames = frames;
    request.database = (folder_ / "catalogue.sqlite").string();
    request.params.fusion.working_width = 160;  // quick; nothing here depends on it
    return request;
  }

  /// The next snapshot that says `frames_done` frames; steps post one each.
  std::shared_ptr<const ScanSnapshot> awaitSnapshot(int frames_done) {
    for (int i = 0; i < 12000; ++i) {
      if (auto snapshot = session_.snapshots().collect(); snapshot && snapshot->frames_done >= frames_done) {
        return snapshot;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return nullptr;
  }

  test::QtMainThread qt_;
  test::TemporaryFolder folder_;
  EventLog log_;
  ScanSession session_{[this](const ScanEvent& event) { log_.add(event); }};
};

TEST_F(ScanSessionTest, RunsARecordingToItsEnd) {
  session_.start(request(4));
  session_.wait();
  EXPECT_THAT(log_.states(), ElementsAre(ScanState::starting, ScanState::scanning, ScanState::stopping,
                                         ScanState::finished));
  EXPECT_EQ(session_.state(), ScanState::finished);
}

TEST_F(ScanSessionTest, StepsAreOneFrameEach) {
  ScanRequest paused = request(10);
  paused.start_paused = true;
  session_.start(std::move(paused));
  log_.awaitState(ScanState::paused);
  for (int step = 1; step <= 3; ++step) {
    session_.step();
    const auto snapshot = awaitSnapshot(step);
    ASSERT_TRUE(snapshot);
    EXPECT_EQ(snapshot->frames_done, step);
    EXPECT_EQ(snapshot->state, ScanState::paused);
    EXPECT_EQ(snapshot->frames_total, 10);
  }
  session_.resume();
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::finished);
}

TEST_F(ScanSessionTest, StopEndsAScanCleanlyWithItsResults) {
  ScanRequest long_scan = request(150);
  long_scan.output_folder = folder_ / "out";
  session_.start(std::move(long_scan));
  ASSERT_TRUE(awaitSnapshot(2));
  session_.stop();
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::finished);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "report.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "cloud.ply"));
}

TEST_F(ScanSessionTest, PauseHoldsAndResumeGoesOn) {
  session_.start(request(60));
  ASSERT_TRUE(awaitSnapshot(1));
  session_.pause();
  log_.awaitState(ScanState::paused);
  const auto held = awaitSnapshot(1);
  ASSERT_TRUE(held);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(session_.snapshots().collect()) << "a paused scan went on";
  session_.resume();
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::finished);
}

TEST_F(ScanSessionTest, AFailedStartIsToldAndTheNextOneWorks) {
  ScanRequest wrong = request(3);
  wrong.source = "/no/such/recording";
  session_.start(std::move(wrong));
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("/no/such/recording"));
  session_.start(request(2));
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::finished);
}

TEST_F(ScanSessionTest, ANewStartEndsTheOldScan) {
  session_.start(request(150));
  ASSERT_TRUE(awaitSnapshot(1));
  session_.start(request(2));
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::finished);
  const std::vector<ScanState> states = log_.states();
  EXPECT_EQ(std::count(states.begin(), states.end(), ScanState::starting), 2);
}

TEST_F(ScanSessionTest, GivenPosesAreRefusedWhereThereAreNone) {
  ScanRequest given = request(3);
  given.source = "camera:Dummy";
  given.poses = ScanRequest::Poses::given;
  session_.start(std::move(given));
  session_.wait();
  EXPECT_EQ(session_.state(), ScanState::failed);
  EXPECT_THAT(log_.failure(), HasSubstr("has no poses"));
}

// The window may be slow: what a skipped snapshot held comes with the next.
TEST_F(ScanSessionTest, ChangedBricksOfUncollectedSnapshotsAreNotLost) {
  session_.start(request(6));
  session_.wait();
  const auto last = session_.snapshots().collect();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state, ScanState::finished);
  EXPECT_EQ(last->frames_done, 6);
  ASSERT_TRUE(last->region_of_label);
  std::set<std::tuple<int, int, int>> bricks;
  std::size_t points = 0;
  for (const CloudBrick& brick : last->changed_bricks) {
    bricks.insert({brick.position.x(), brick.position.y(), brick.position.z()});
    points += brick.points.size();
    for (const CloudBrick::Point& point : brick.points) ASSERT_LT(point.label, last->region_of_label->size());
  }
  EXPECT_GT(points, 10000U);

  // The same scan, collected all the way, sends the same bricks.
  std::set<std::tuple<int, int, int>> bricks_again;
  ScanSession other([](const ScanEvent&) {});
  other.start(request(6));
  while (other.state() != ScanState::finished || !other.snapshots().empty()) {
    const auto snapshot = other.snapshots().collect();
    if (!snapshot) continue;
    for (const CloudBrick& brick : snapshot->changed_bricks) {
      bricks_again.insert({brick.position.x(), brick.position.y(), brick.position.z()});
    }
  }
  EXPECT_EQ(bricks_again, bricks);
}

}  // namespace
}  // namespace scantrove
