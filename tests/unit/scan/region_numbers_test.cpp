#include "core/scan/region_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace scantrove {
namespace {

TEST(RegionNumbers, AreGivenInOrderKeptAndKnownBackwards) {
  RegionNumbers numbers;
  EXPECT_EQ(numbers.numbersOf(std::vector<RegionId>{{0}, {900}, {900}, {70000}, {0}, {900}}),
            (std::vector<std::uint32_t>{0, 1, 1, 2, 0, 1}));
  EXPECT_EQ(numbers.numberOf(RegionId{70000}), 2U);
  EXPECT_EQ(numbers.regionOf(2), RegionId{70000});
  EXPECT_EQ(numbers.regionOf(0), RegionId{});
  EXPECT_EQ(numbers.count(), 3U);
}

// More regions than 16 bits hold, as a long scan meets them: a few at a time.
TEST(RegionNumbers, NeverGrowPast16BitsAndDifferWithinAnImage) {
  RegionNumbers numbers;
  const RegionId floor{1};
  for (std::uint32_t region = 2; region < 70000; region += 4) {
    const std::vector<std::uint32_t> image =
        numbers.numbersOf(std::vector<RegionId>{floor, {region}, {region + 1}, {region + 2}, {region + 3}});
    ASSERT_EQ(image[0], 1U) << "what is in view keeps its number";
    ASSERT_EQ(std::set<std::uint32_t>(image.begin(), image.end()).size(), 5U) << region;
    ASSERT_LE(*std::ranges::max_element(image), 65535U) << region;
  }
  EXPECT_EQ(numbers.count(), 65536U);
}

}  // namespace
}  // namespace scantrove
