#include "core/capture/rest_of_source.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <vector>

namespace scantrove::test {
namespace {

using Status = FrameRead::Status;

/// Frames and unusable frames by their numbers.
class NumberedReads final : public FrameSource {
 public:
  struct Read {
    int index = 0;
    Status status = Status::frame;
  };
  explicit NumberedReads(std::deque<Read> reads) : reads_(std::move(reads)) {
    info_.frame_count = static_cast<int>(reads_.size());
  }
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override {
    FrameRead read;
    if (reads_.empty()) return read;
    read.status = reads_.front().status;
    read.frame.index = reads_.front().index;
    reads_.pop_front();
    return read;
  }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override {
    return reads_.empty() ? std::nullopt : std::optional(next());
  }

 private:
  SourceInfo info_;
  std::deque<Read> reads_;
};

std::vector<int> framesOf(FrameSource& source, int& timeouts) {
  std::vector<int> frames;
  for (FrameRead read = source.next(); read.status != Status::end; read = source.next()) {
    if (read.status == Status::frame) frames.push_back(read.frame.index);
    timeouts += read.status == Status::timeout ? 1 : 0;
  }
  return frames;
}

TEST(RestOfSource, LeavesOutFrames_UpToTheLastOne) {
  RestOfSource rest(std::make_unique<NumberedReads>(std::deque<NumberedReads::Read>{{10}, {12}, {14}, {16}}),
                    12, 2);
  EXPECT_EQ(rest.info().frame_count, 2);
  int timeouts = 0;
  EXPECT_EQ(framesOf(rest, timeouts), (std::vector<int>{14, 16}));
  EXPECT_EQ(timeouts, 2) << "a scan can be stopped meanwhile";
}

TEST(RestOfSource, ReportsUnusableFrames_OfTheRestOnly) {
  RestOfSource rest(std::make_unique<NumberedReads>(std::deque<NumberedReads::Read>{
                        {0}, {1, Status::skipped}, {2}, {3}, {0, Status::skipped}, {5}}),
                    2, 2);
  for (const Status expected : {Status::timeout, Status::timeout, Status::timeout, Status::frame,
                                Status::skipped, Status::frame, Status::end})
    EXPECT_EQ(rest.next().status, expected);
}

TEST(RestOfSource, IsAtItsEnd_WhenNothingIsLeft) {
  RestOfSource rest(std::make_unique<NumberedReads>(std::deque<NumberedReads::Read>{{0}, {1}}), 1, 2);
  EXPECT_EQ(rest.info().frame_count, 0);
  EXPECT_EQ(rest.nextIfReady()->status, Status::timeout);
  EXPECT_EQ(rest.nextIfReady()->status, Status::timeout);
  EXPECT_FALSE(rest.nextIfReady());
  EXPECT_EQ(rest.next().status, Status::end);
}

}  // namespace
}  // namespace scantrove::test
