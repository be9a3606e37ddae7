#include "core/discovery/region_rules.h"

#include <gtest/gtest.h>

#include <functional>

namespace scantrove {
namespace {

TEST(RegionRules, WhatIsThinAndDoesNotBulgeIsAStrip) {
  const DiscoveryParams params;
  const auto boxOf = [](float length_m, float width_m) {
    OrientedBox box;
    box.size_m = {length_m, width_m, 0.02F};
    return box;
  };
  EXPECT_FALSE(isNotStrip(boxOf(0.4F, 0.05F), 0.0F, params)) << "the edge of a shelf";
  EXPECT_TRUE(isNotStrip(boxOf(0.15F, 0.01F), 0.5F, params)) << "a pen";
  EXPECT_TRUE(isNotStrip(boxOf(0.25F, 0.15F), 0.03F, params)) << "a book that lies";
  EXPECT_FALSE(isNotStrip(boxOf(0.6F, 0.05F), 0.3F, params)) << "the leg of a table";
  EXPECT_TRUE(isNotStrip(boxOf(0.3F, 0.06F), 0.3F, params)) << "a bottle";
  DiscoveryParams all;
  all.min_strip_ratio = 0;
  EXPECT_TRUE(isNotStrip(boxOf(0.4F, 0.05F), 0.0F, all));
}

TEST(RegionRules, WhatIsLargerThanABookMustBulge) {
  const DiscoveryParams params;
  OrientedBox box;
  box.size_m = {0.5F, 0.4F, 0.05F};
  box.thickness_ratio = 0.06F;
  EXPECT_FALSE(isNotFlat(box, 0.03F, params)) << "the door of a cupboard";
  EXPECT_TRUE(isNotFlat(box, 0.3F, params)) << "a cushion";
  box.size_m = {0.35F, 0.25F, 0.02F};
  EXPECT_TRUE(isNotFlat(box, 0.0F, params)) << "a book";
}

TEST(RegionRules, APartOfAThingIsClearWhereNothingElseCanBeMeant) {
  PartialLook clear;
  clear.shown_part = 0.9F;
  clear.bulge = 0.3F;
  clear.known.box.size_m = {0.2F, 0.15F, 0.1F};
  clear.outline = {.open = 40, .folded = 20, .smooth = 2, .ridged = 2, .hidden = 10, .cut = 20, .unseen = 10};
  clear.odds = -3;
  EXPECT_TRUE(isClearInPart(clear));
  const auto isClearWith = [&clear](const std::function<void(PartialLook&)>& change) {
    PartialLook look = clear;
    change(look);
    return isClearInPart(look);
  };
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.shown_part = 0.6F; })) << "much of it is elsewhere";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.bulge = 0.05F; })) << "a patch of the table";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.known.box.size_m[0] = 0.65F; }))
      << "a corner of a chest";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.outline.smooth = 30; })) << "it goes on";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.outline.hidden = 90; })) << "it is behind something";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.outline.cut = 80; })) << "half of it is outside";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.outline.unseen = 60; }))
      << "nobody knows how it ends";
  EXPECT_FALSE(isClearWith([](PartialLook& look) { look.odds = -0.3F; })) << "it may be a part of that";
}

}  // namespace
}  // namespace scantrove
