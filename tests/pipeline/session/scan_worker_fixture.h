#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/scan/scan_worker.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// Collects the events of a scan on the worker thread; tests wait for them.
class EventLog {
 public:
  void add(const ScanEvent& event) {
    const std::scoped_lock lock(mutex_);
    events_.push_back(event);
    arrived_.notify_all();
  }

  /// Waits until the scan enters `state` for the `times`-th time.
  void awaitState(ScanState state, int times = 1) {
    std::unique_lock lock(mutex_);
    const bool in_time =
        arrived_.wait_for(lock, std::chrono::seconds(120), [&] { return countOf(state) >= times; });
    ASSERT_TRUE(in_time) << "state " << static_cast<int>(state) << " did not come";
  }

  /// Waits for `count` events of a kind.
  template <class Event>
  void await(std::size_t count = 1) {
    std::unique_lock lock(mutex_);
    const auto has = [&] {
      std::size_t found = 0;
      for (const ScanEvent& event : events_) found += std::holds_alternative<Event>(event) ? 1U : 0U;
      return found >= count;
    };
    ASSERT_TRUE(arrived_.wait_for(lock, std::chrono::seconds(120), has)) << "an event did not come";
  }

  [[nodiscard]] std::vector<ScanState> states() {
    const std::scoped_lock lock(mutex_);
    std::vector<ScanState> states;
    for (const ScanEvent& event : events_) {
      if (const auto* changed = std::get_if<StateChanged>(&event)) states.push_back(changed->state);
    }
    return states;
  }

  /// All events of one kind so far.
  template <class Event>
  [[nodiscard]] std::vector<Event> all() {
    const std::scoped_lock lock(mutex_);
    std::vector<Event> found;
    for (const ScanEvent& event : events_) {
      if (const auto* requested = std::get_if<Event>(&event)) found.push_back(*requested);
    }
    return found;
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

class ScanWorkerTest : public testing::Test {
 protected:
  [[nodiscard]] ScanRequest request(int frames) const {
    ScanRequest request;
    request.source = "demo";
    request.source_options.frames = frames;
    request.database = (folder_ / "catalogue.sqlite").string();
    request.params.fusion.working_width = 160;  // for speed; no test depends on it
    return request;
  }

  /// The next snapshot with at least `frames_done` frames; each step posts one. Null: none comes.
  std::shared_ptr<const ScanSnapshot> awaitSnapshot(int frames_done) {
    for (int i = 0; i < 12000; ++i) {
      if (auto snapshot = worker_.snapshots().collect(); snapshot && snapshot->frames.done() >= frames_done) {
        return snapshot;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return nullptr;
  }

  QtMainThread qt_;
  TemporaryFolder folder_;
  EventLog log_;
  ScanWorker worker_{[this](const ScanEvent& event) { log_.add(event); }};
};

}  // namespace scantrove::test
