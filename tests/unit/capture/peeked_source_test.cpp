#include "core/capture/peeked_source.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

/// Two frames, then the end.
class TwoFrames final : public FrameSource {
 public:
  const SourceInfo& info() const override { return info_; }
  FrameRead next() override {
    FrameRead read;
    if (given_ == 2) return read;
    read.status = FrameRead::Status::frame;
    read.frame.index = given_++;
    return read;
  }
  std::optional<FrameRead> nextIfReady() override { return next(); }

 private:
  SourceInfo info_;
  int given_ = 0;
};

TEST(PeekedSource, ReturnsEachFrameOnce_AlsoThePeekedOne) {
  PeekedSource source(std::make_unique<TwoFrames>());
  EXPECT_EQ(source.peek().frame.index, 0);
  EXPECT_EQ(source.peek().frame.index, 0);
  EXPECT_EQ(source.next().frame.index, 0);
  EXPECT_EQ(source.next().frame.index, 1);
  EXPECT_EQ(source.next().status, FrameRead::Status::end);
}

TEST(PeekedSource, GivesThePeekedFrameToWhoDoesNotWait) {
  PeekedSource source(std::make_unique<TwoFrames>());
  EXPECT_EQ(source.peek().frame.index, 0);
  ASSERT_TRUE(source.nextIfReady());
  EXPECT_EQ(source.nextIfReady()->frame.index, 1);
}

}  // namespace
}  // namespace scantrove
