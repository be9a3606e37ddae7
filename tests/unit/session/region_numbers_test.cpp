#include "core/session/region_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace scantrove {
namespace {

TEST(RegionNumbers, EqualRegionIds_Within16Bits) {
  RegionNumbers numbers;
  EXPECT_EQ(numbers.numbersOf(std::vector<RegionId>{{0}, {900}, {900}, {7}, {0}, {65535}}),
            (std::vector<std::uint32_t>{0, 900, 900, 7, 0, 65535}));
  EXPECT_EQ(numbers.regionOf(900), RegionId{900});
  EXPECT_EQ(numbers.regionOf(0), RegionId{});
  EXPECT_EQ(numbers.regionOf(8), RegionId{}) << "not written";
  EXPECT_EQ(numbers.knownNumberOf(RegionId{7}), 7U);
  EXPECT_FALSE(numbers.knownNumberOf(RegionId{8}));
  EXPECT_EQ(numbers.count(), 4U);
}

TEST(RegionNumbers, ReuseAFreeNumber_WhenAnIdExceeds16Bits) {
  RegionNumbers numbers;
  EXPECT_EQ(numbers.numberOf(RegionId{1}), 1U);
  EXPECT_EQ(numbers.numberOf(RegionId{70000}), 2U) << "the first free number";
  EXPECT_EQ(numbers.numberOf(RegionId{70000}), 2U) << "unchanged";
  const std::uint32_t second = numbers.numberOf(RegionId{2});
  EXPECT_NE(second, 2U) << "its id is taken";
  EXPECT_NE(second, 1U);
  EXPECT_EQ(numbers.knownNumberOf(RegionId{2}), second);
}

// A long scan adds more regions than 16 bits can number, a few per image.
TEST(RegionNumbers, StayWithin16BitsAndDifferWithinAnImage) {
  RegionNumbers numbers;
  const RegionId floor{1};
  for (std::uint32_t region = 2; region < 70000; region += 4) {
    const std::vector<std::uint32_t> image =
        numbers.numbersOf(std::vector<RegionId>{floor, {region}, {region + 1}, {region + 2}, {region + 3}});
    ASSERT_EQ(image[0], 1U) << "a visible region keeps its number";
    ASSERT_EQ(std::set<std::uint32_t>(image.begin(), image.end()).size(), 5U) << region;
    ASSERT_LE(*std::ranges::max_element(image), 65535U) << region;
  }
  EXPECT_EQ(numbers.count(), 65536U);
}

}  // namespace
}  // namespace scantrove
