#include "core/capture/read_ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>

namespace scantrove {
namespace {

using namespace std::chrono_literals;
using Status = FrameRead::Status;

/// Returns the result of `script` for call 0, 1, ...
class FakeSource final : public FrameSource {
 public:
  FakeSource(bool is_live, std::function<FrameRead(int)> script, std::atomic<int>& calls)
      : script_(std::move(script)), calls_(calls) {
    info_.name = "fake";
    info_.is_live = is_live;
  }
  const SourceInfo& info() const override { return info_; }
  FrameRead next() override { return script_(calls_++); }

 private:
  SourceInfo info_;
  std::function<FrameRead(int)> script_;
  std::atomic<int>& calls_;
};

FrameRead frameNumber(int index) {
  FrameRead read;
  read.status = Status::frame;
  read.frame.index = index;
  return read;
}

FrameRead statusOnly(Status status) {
  FrameRead read;
  read.status = status;
  return read;
}

/// Waits at most five seconds for another thread.
bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 5000 && !condition(); ++i) {
    std::this_thread::sleep_for(1ms);
  }
  return condition();
}

TEST(ReadAhead, ReturnsEveryRecordedFrameInOrderAndEnds) {
  std::atomic<int> calls = 0;
  ReadAhead reader(std::make_unique<FakeSource>(
      false, [](int call) { return call < 100 ? frameNumber(call) : statusOnly(Status::end); }, calls));
  for (int i = 0; i < 100; ++i) {
    const FrameRead read = reader.next();
    ASSERT_EQ(read.status, Status::frame);
    ASSERT_EQ(read.frame.index, i);
    ASSERT_EQ(read.dropped, 0);
  }
  EXPECT_EQ(reader.next().status, Status::end);
  EXPECT_EQ(reader.next().status, Status::end);
  EXPECT_EQ(calls, 101);
}

TEST(ReadAhead, ReturnsAtOnce_WhenAskedForReadyFrames) {
  std::atomic<int> calls = 0;
  std::atomic<bool> may_continue = false;
  ReadAhead reader(std::make_unique<FakeSource>(
      false,
      [&](int call) {
        if (call == 1) eventually([&] { return may_continue.load(); });
        return call < 2 ? frameNumber(call) : statusOnly(Status::end);
      },
      calls));
  ASSERT_EQ(reader.next().frame.index, 0);
  EXPECT_FALSE(reader.nextIfReady());  // the second is still being read
  may_continue = true;
  std::optional<FrameRead> second;
  ASSERT_TRUE(eventually([&] { return second || (second = reader.nextIfReady()); }));
  EXPECT_EQ(second->frame.index, 1);
  std::optional<FrameRead> last;
  ASSERT_TRUE(eventually([&] { return last || (last = reader.nextIfReady()); }));
  EXPECT_EQ(last->status, Status::end);
  EXPECT_FALSE(reader.nextIfReady());
  EXPECT_EQ(reader.next().status, Status::end);
}

TEST(ReadAhead, StopsReading_WhenItsQueueIsFull) {
  std::atomic<int> calls = 0;
  ReadAhead reader(std::make_unique<FakeSource>(false, frameNumber, calls), 4);
  EXPECT_TRUE(eventually([&] { return calls == 5; }));  // four queued, one in hand
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(reader.next().frame.index, 0);
  EXPECT_TRUE(eventually([&] { return calls == 6; }));
}

TEST(ReadAhead, EndsItsThread_WhenDestroyedWithAFullQueue) {
  std::atomic<int> calls = 0;
  {
    const ReadAhead reader(std::make_unique<FakeSource>(false, frameNumber, calls), 2);
    EXPECT_TRUE(eventually([&] { return calls == 3; }));
  }
  EXPECT_EQ(calls, 3);
}

TEST(ReadAhead, WakesAWaitingReader_WhenCanceled) {
  std::atomic<int> calls = 0;
  std::atomic<bool> is_released = false;
  ReadAhead reader(std::make_unique<FakeSource>(
      false,
      [&](int call) {
        eventually([&] { return is_released.load(); });
        return frameNumber(call);
      },
      calls));
  std::jthread canceller([&] {
    std::this_thread::sleep_for(20ms);
    reader.cancel();
  });
  EXPECT_EQ(reader.next().status, Status::end);
  is_released = true;
}

TEST(ReadAhead, KeepsTheNewestAndCountsDropped_WhenLive) {
  std::atomic<int> calls = 0;
  std::atomic<int> allowed = 10;
  ReadAhead reader(std::make_unique<FakeSource>(
      true,
      [&](int call) {
        eventually([&] { return call < allowed; });
        return call < 12 ? frameNumber(call) : statusOnly(Status::failed);
      },
      calls));
  ASSERT_TRUE(eventually([&] { return calls == 11; }));  // ten posted, the eleventh waits
  const FrameRead newest = reader.next();
  EXPECT_EQ(newest.frame.index, 9);
  EXPECT_EQ(newest.dropped, 9);
  allowed = 11;
  const FrameRead following = reader.next();
  EXPECT_EQ(following.frame.index, 10);
  EXPECT_EQ(following.dropped, 0);
  allowed = 100;  // the failure must not discard the last frame
  EXPECT_EQ(reader.next().frame.index, 11);
  EXPECT_EQ(reader.next().status, Status::failed);
}

TEST(ReadAhead, PassesTimeoutsWithoutReplacingFrames_WhenLive) {
  std::atomic<int> calls = 0;
  std::atomic<int> allowed = 2;
  ReadAhead reader(std::make_unique<FakeSource>(
      true,
      [&](int call) {
        eventually([&] { return call < allowed; });
        return call == 0 ? frameNumber(0) : statusOnly(Status::timeout);
      },
      calls));
  ASSERT_TRUE(eventually([&] { return calls == 3; }));
  EXPECT_EQ(reader.next().status, Status::frame);
  allowed = 3;
  EXPECT_EQ(reader.next().status, Status::timeout);
  allowed = 1'000'000;
}

TEST(ReadAhead, Fails_WhenTheSourceThrows) {
  std::atomic<int> calls = 0;
  ReadAhead reader(std::make_unique<FakeSource>(
      false, [](int call) { return call == 0 ? frameNumber(0) : throw std::runtime_error("decoder broke"); },
      calls));
  EXPECT_EQ(reader.next().status, Status::frame);
  const FrameRead failed = reader.next();
  EXPECT_EQ(failed.status, Status::failed);
  EXPECT_NE(failed.error.what.find("decoder broke"), std::string::npos);
  EXPECT_EQ(reader.next().status, Status::end);
}

}  // namespace
}  // namespace scantrove
