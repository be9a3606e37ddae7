#include "core/collection/recognition_history.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

const RegionSet kRegions{RegionId{3}};
constexpr float kMax = 0.5F;

/// The verdict after comparisons that found these objects, 0 = none, each at the given distance.
std::optional<ObjectId> after(const std::vector<std::uint32_t>& named, float distance = 0.4F) {
  RecognitionHistory history;
  int frame = 0;
  for (const std::uint32_t object : named)
    history.add(kRegions, {ObjectId{object}, {}, object == 0 ? 2 : distance}, kMax, frame += 5);
  return history.verdict(kRegions);
}

TEST(RecognitionHistory, Recognizes_WhenTwoAttemptsAgree) {
  EXPECT_FALSE(after({}).has_value());
  EXPECT_FALSE(after({7}).has_value());
  EXPECT_EQ(after({7, 7}), ObjectId{7});
  EXPECT_FALSE(after({7, 8}).has_value());
  EXPECT_EQ(after({7, 0, 8, 0, 7}), ObjectId{7});
}

TEST(RecognitionHistory, Recognizes_ByOneSureAttempt) {
  EXPECT_EQ(after({7}, 0.2F), ObjectId{7});
  EXPECT_EQ(after({7}, 0.26F), std::nullopt) << "half of the required evidence";
}

TEST(RecognitionHistory, SaysUnknown_AfterSeveralAttempts) {
  EXPECT_FALSE(after({0, 0, 0}).has_value());
  EXPECT_EQ(after({0, 0, 0, 0}), ObjectId{});
  EXPECT_FALSE(after({0, 7, 0, 0, 0}).has_value()) << "one attempt named it; its other sides may be unknown";
  EXPECT_EQ(after({0, 7, 0, 0, 0, 0, 0, 0}), ObjectId{});
}

TEST(RecognitionHistory, NextAttemptIsDue_AfterAFewFrames) {
  RecognitionHistory history;
  EXPECT_TRUE(history.isAttemptDue(kRegions, 10));
  history.add(kRegions, {}, kMax, 10);
  EXPECT_FALSE(history.isAttemptDue(kRegions, 10 + RecognitionHistory::kFramesApart - 1));
  EXPECT_TRUE(history.isAttemptDue(kRegions, 10 + RecognitionHistory::kFramesApart));
}

TEST(RecognitionHistory, ForgetsOldAndJoinedRegions) {
  RecognitionHistory history;
  history.add(kRegions, {}, kMax, 10);
  history.forgetBefore(10);
  EXPECT_EQ(history.attempts(kRegions), 1);
  history.forgetRegion(RegionId{4});
  EXPECT_EQ(history.attempts(kRegions), 1);
  history.forgetRegion(RegionId{3});
  EXPECT_EQ(history.attempts(kRegions), 0);
  history.add(kRegions, {}, kMax, 10);
  history.forgetBefore(11);
  EXPECT_EQ(history.attempts(kRegions), 0);
}

}  // namespace
}  // namespace scantrove
