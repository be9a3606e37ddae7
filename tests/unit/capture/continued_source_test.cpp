#include "core/capture/continued_source.h"

#include <gtest/gtest.h>

#include <deque>

namespace scantrove::test {
namespace {

struct Stamp {
  int index = 0;
  double time_s = 0;
};

class ListedFrames final : public FrameSource {
 public:
  explicit ListedFrames(std::deque<Stamp> stamps) : stamps_(std::move(stamps)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (stamps_.empty()) return read;
    read.status = FrameRead::Status::frame;
    read.frame.index = stamps_.front().index;
    read.frame.timestamp_s = stamps_.front().time_s;
    stamps_.pop_front();
    return read;
  }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override {
    return stamps_.empty() ? std::nullopt : std::optional(next());
  }

 private:
  SourceInfo info_;
  std::deque<Stamp> stamps_;
};

TEST(ContinuedSource, ShiftsNumbersAndTimes_WhenTheRecordingStartsBeforeTheScanEnds) {
  ContinuedSource source(std::make_unique<ListedFrames>(std::deque<Stamp>{{3, 0.1}, {5, 0.2}, {6, 0.25}}), 29,
                         29 / 30.0);
  const FrameRead first = source.next();
  EXPECT_EQ(first.frame.index, 30);
  EXPECT_NEAR(first.frame.timestamp_s, 1.0, 1e-9);
  const std::optional<FrameRead> second = source.nextIfReady();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->frame.index, 32);
  EXPECT_NEAR(second->frame.timestamp_s, 1.1, 1e-9);
  EXPECT_EQ(source.next().frame.index, 33);
  EXPECT_EQ(source.shift().index, 27);
  EXPECT_NEAR(source.shift().time_s, 0.9, 1e-9);
  EXPECT_EQ(source.next().status, FrameRead::Status::end);
}

TEST(ContinuedSource, KeepsNumbersAndTimes_WhenTheRecordingBeginsLater) {
  ContinuedSource source(std::make_unique<ListedFrames>(std::deque<Stamp>{{30, 1.0}, {31, 1.1}}), 29,
                         29 / 30.0);
  EXPECT_EQ(source.next().frame.index, 30);
  EXPECT_EQ(source.next().frame.timestamp_s, 1.1);
  EXPECT_EQ(source.shift().index, 0);
  EXPECT_EQ(source.shift().time_s, 0);
}

TEST(ContinuedSource, ShiftsOnlyNumbers_WhenOnlyTheyDecrease) {
  ContinuedSource source(std::make_unique<ListedFrames>(std::deque<Stamp>{{0, 1305031102.5}}), 29, 29 / 30.0);
  const FrameRead first = source.next();
  EXPECT_EQ(first.frame.index, 30);
  EXPECT_EQ(first.frame.timestamp_s, 1305031102.5);
}

TEST(ContinuedSource, KeepsNumbersInRange_WhenTheScanUsedTheLargest) {
  ContinuedSource source(std::make_unique<ListedFrames>(std::deque<Stamp>{{0, 0}, {1, 0.1}}), 0x7fffffff, 1);
  EXPECT_EQ(source.next().frame.index, 0x7fffffff);
  EXPECT_EQ(source.next().frame.index, 0x7fffffff);
}

}  // namespace
}  // namespace scantrove::test
