#include "core/discovery/region_rules.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(RegionRules, RegionIsAStrip_WhenThinWithoutBulgeOrTooLong) {
  const DiscoveryParams params;
  const auto boxOf = [](float length_m, float width_m) {
    OrientedBox box;
    box.size_m = {length_m, width_m, 0.02F};
    return box;
  };
  EXPECT_TRUE(isStrip(boxOf(0.4F, 0.05F), 0.0F, params)) << "the edge of a shelf";
  EXPECT_FALSE(isStrip(boxOf(0.15F, 0.01F), 0.5F, params)) << "a pen";
  EXPECT_FALSE(isStrip(boxOf(0.25F, 0.15F), 0.03F, params)) << "a book lying flat";
  EXPECT_TRUE(isStrip(boxOf(0.6F, 0.05F), 0.3F, params)) << "the leg of a table";
  EXPECT_FALSE(isStrip(boxOf(0.3F, 0.06F), 0.3F, params)) << "a bottle";
  DiscoveryParams all;
  all.min_strip_ratio = 0;
  EXPECT_FALSE(isStrip(boxOf(0.4F, 0.05F), 0.0F, all));
}

TEST(RegionRules, RegionIsFlat_WhenLargerThanABookWithoutBulge) {
  const DiscoveryParams params;
  OrientedBox box;
  box.size_m = {0.5F, 0.4F, 0.05F};
  box.thickness_ratio = 0.06F;
  EXPECT_TRUE(isFlat(box, 0.03F, params)) << "the door of a cupboard";
  EXPECT_FALSE(isFlat(box, 0.3F, params)) << "a cushion";
  box.size_m = {0.35F, 0.25F, 0.02F};
  EXPECT_FALSE(isFlat(box, 0.0F, params)) << "a book";
}

}  // namespace
}  // namespace scantrove
