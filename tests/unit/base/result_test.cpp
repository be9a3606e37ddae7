#include "core/base/result.h"

#include <gtest/gtest.h>

#include <unordered_set>

#include "core/base/check.h"
#include "core/base/ids.h"

namespace scantrove {
namespace {

Result<int> half(int n) {
  if (n % 2 != 0) return fail(std::to_string(n) + " is odd.", "Take an even number.");
  return n / 2;
}

Result<void> halveTwice(int n, int& steps) {
  SCANTROVE_TRY(half(n));
  ++steps;
  SCANTROVE_TRY(half(n / 2));
  ++steps;
  return {};
}

TEST(Result, HoldsTheValue) {
  const Result<int> result = half(6);
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, 3);
}

TEST(Result, ErrorMessageHasCauseAndAdvice) {
  const Result<int> result = half(7);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message(), "7 is odd. Take an even number.");
  EXPECT_EQ((Error{"Only this.", ""}.message()), "Only this.");
}

TEST(Result, TryReturnsTheFirstError) {
  int steps = 0;
  EXPECT_TRUE(halveTwice(12, steps));
  EXPECT_EQ(steps, 2);
  steps = 0;
  const Result<void> result = halveTwice(6, steps);
  ASSERT_FALSE(result);
  EXPECT_EQ(steps, 1);
  EXPECT_EQ(result.error().what, "3 is odd.");
}

TEST(Result, ErrorConvertsToResultsOfOtherTypes) {
  const auto caller = []() -> Result<std::string> {
    const Result<int> result = half(5);
    if (!result) return fail(result.error());
    return std::to_string(*result);
  };
  EXPECT_EQ(caller().error().advice, "Take an even number.");
}

TEST(CheckDeathTest, AbortsWithConditionFileAndLine) {
  EXPECT_DEATH(SCANTROVE_CHECK(1 + 1 == 3),
               "internal error: 1 \\+ 1 == 3 does not hold at .*result_test.cpp");
}

TEST(Ids, AreDistinctTypes) {
  static_assert(!std::is_convertible_v<RegionId, ObjectId>);
  static_assert(!std::is_convertible_v<std::uint32_t, RegionId>);
  EXPECT_FALSE(RegionId{});
  EXPECT_TRUE(RegionId{1});
  EXPECT_LT(RegionId{1}, RegionId{2});
  const std::unordered_set<ObjectId> ids{ObjectId{1}, ObjectId{2}, ObjectId{1}};
  EXPECT_EQ(ids.size(), 2U);
}

}  // namespace
}  // namespace scantrove
