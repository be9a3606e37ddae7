#include "core/base/soft_bin.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(SoftBin, DistributesAValueToTheTwoNearestBins) {
  const SoftBin bin = SoftBin::at(2.25F, 5);
  EXPECT_EQ(bin.bin, 2U);
  EXPECT_FLOAT_EQ(bin.lower, 0.75F);
  EXPECT_FLOAT_EQ(bin.upper, 0.25F);
}

TEST(SoftBin, ClampsValues_BeyondTheEnds) {
  const SoftBin below = SoftBin::at(-3, 5), above = SoftBin::at(9, 5);
  EXPECT_EQ(below.bin, 0U);
  EXPECT_EQ(below.lower, 1);
  EXPECT_EQ(above.bin, 3U) << "the next bin is the last";
  EXPECT_NEAR(above.upper, 1, 2e-3F);
}

}  // namespace
}  // namespace scantrove
