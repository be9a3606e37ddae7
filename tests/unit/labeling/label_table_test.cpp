#include "core/labeling/label_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scantrove {
namespace {

TEST(LabelTable, NewLabelsAreRegionsOfTheirOwn) {
  LabelTable table;
  EXPECT_EQ(table.regionOf(0), RegionId{0});
  const RegionId a = table.newLabel();
  const RegionId b = table.newLabel();
  EXPECT_NE(a, b);
  EXPECT_EQ(table.regionOf(a.value), a);
}

TEST(LabelTable, JoinNamesTheRegionAfterTheFirstAndReachesAllItsLabels) {
  LabelTable table;
  const RegionId a = table.newLabel();
  const RegionId b = table.newLabel();
  const RegionId c = table.newLabel();
  EXPECT_TRUE(table.join(b, c));
  EXPECT_TRUE(table.join(a, c));  // c is b's, so b joins a
  EXPECT_FALSE(table.join(c, b)) << "already one";
  for (const RegionId id : {a, b, c}) EXPECT_EQ(table.regionOf(id.value), a);
  EXPECT_EQ(table.regionOfLabel(), (std::vector<std::uint32_t>{0, a.value, a.value, a.value}));
}

TEST(LabelTable, UnlabelledJoinsNothing) {
  LabelTable table;
  const RegionId a = table.newLabel();
  EXPECT_FALSE(table.join(a, RegionId{}));
  EXPECT_FALSE(table.join(RegionId{}, a));
}

TEST(LabelTable, RegionsAreThoseOfTheGraphOfJoins) {
  // Of joins in any order: two labels are one region where a chain of joins leads from one to the other.
  std::mt19937 random(3);
  constexpr std::uint32_t kLabels = 60;
  LabelTable table;
  std::vector<std::uint32_t> component(kLabels + 1);
  for (std::uint32_t label = 1; label <= kLabels; ++label) component[label] = table.newLabel().value;
  for (int i = 0; i < 50; ++i) {
    const RegionId into{1 + static_cast<std::uint32_t>(random() % kLabels)};
    const RegionId from{1 + static_cast<std::uint32_t>(random() % kLabels)};
    const std::uint32_t kept = component[into.value], gone = component[from.value];
    EXPECT_EQ(table.join(into, from), kept != gone);
    std::ranges::replace(component, gone, kept);
    EXPECT_EQ(table.regionOfLabel(), component);
  }
}

}  // namespace
}  // namespace scantrove
