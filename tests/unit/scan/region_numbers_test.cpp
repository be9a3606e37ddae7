#include "core/scan/region_numbers.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(RegionNumbers, AreGivenInOrderKeptAndKnownBackwards) {
  RegionNumbers numbers;
  EXPECT_EQ(numbers.numbersOf(std::vector<std::uint32_t>{0, 900, 900, 70000, 0, 900}),
            (std::vector<std::uint32_t>{0, 1, 1, 2, 0, 1}));
  EXPECT_EQ(numbers.numberOf(70000), 2U);
  EXPECT_EQ(numbers.regionOf(2), 70000U);
  EXPECT_EQ(numbers.regionOf(0), 0U);
  EXPECT_EQ(numbers.count(), 3U);
}

}  // namespace
}  // namespace scantrove
