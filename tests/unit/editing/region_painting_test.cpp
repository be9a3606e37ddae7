// Paintings on the strip of RegionEditorTest, seen straight from above: 1 pixel = 1 voxel = 1 cm.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/editing/region_editor_fixture.h"

namespace scantrove::test {
namespace {

using Area = PaintedSurface::Area;
using testing::Contains;
using testing::HasSubstr;

class RegionPaintingTest : public RegionEditorTest {
 protected:
  /// Columns of voxels, from .. to - 1.
  struct Range {
    int from = 0, to = 0;
    [[nodiscard]] bool has(int x) const { return x >= from && x < to; }
  };
  /// Painted columns; one beside an end is unclear. The image ends at `image_end`.
  struct Painting {
    Range added = {}, removed = {};
    int image_end = 80;
    std::vector<RegionId> around = {};
  };

  [[nodiscard]] PaintedSurface surfaceOf(RegionId region, const Painting& painting) const {
    PaintedSurface surface;
    surface.around = painting.around;
    surface.sight = [painting](const Eigen::Vector3f& point) -> PaintedSurface::Sight {
      const int x = static_cast<int>(std::floor(100 * point.x()));
      if (x >= painting.image_end) return {};
      for (const auto& [range, area] :
           {std::pair(painting.added, Area::added), std::pair(painting.removed, Area::removed)}) {
        if (range.from == range.to) continue;
        if (Range{range.from - 1, range.from + 1}.has(x) || Range{range.to - 1, range.to + 1}.has(x))
          return {Area::unclear, true};
        if (range.has(x)) return {area, true};
      }
      return {Area::other, true};
    };
    for (int x = 0; x < painting.image_end; ++x) {
      const Eigen::Vector3f place(0.01F * static_cast<float>(x) + 0.005F, 0.055F, 0.005F);
      if (painting.added.has(x) && regionAt(x) != region) surface.added_world[regionAt(x)].push_back(place);
      if (painting.removed.has(x) && regionAt(x) == region) surface.removed_world.push_back(place);
    }
    return surface;
  }
  Result<RegionEditor::Outcome> paint(RegionId region, const Painting& painting) {
    Operation operation{.kind = OperationKind::paint, .regions = {region}};
    operation.correction = MaskCorrection{.added = {80, 10, {0, 1}}, .removed = {80, 10, {}}};
    const PaintedSurface surface = surfaceOf(region, painting);
    return editor_.apply(operation, params_, &surface);
  }
};

TEST_F(RegionPaintingTest, MovesThePartOfARegionThatWasAdded) {
  const std::vector<RegionId> before = all();
  const auto outcome = paint(before[1], {.added = {20, 50}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(regionAt(30), before[1]);
  for (int x = 40; x < 48; ++x) EXPECT_EQ(regionAt(x), before[1]) << x;
  for (int x = 52; x < 60; ++x) EXPECT_EQ(regionAt(x), before[2]) << x;
  EXPECT_EQ(regionAt(70), before[3]);
  EXPECT_THAT(outcome->regions, Contains(before[2]));
}

TEST_F(RegionPaintingTest, JoinsARegion_WhenItsWholeAreaWasAdded) {
  const std::vector<RegionId> before = all();
  const auto outcome = paint(before[1], {.added = {20, 60}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  for (int x = 20; x < 60; ++x) EXPECT_EQ(regionAt(x), before[1]) << x;
  EXPECT_THAT(outcome->events.joined, Contains(std::pair(before[1], before[2])));
  addEvidence(fragments_[1], fragments_[2], false);
  partition();
  EXPECT_EQ(regionAt(30), regionAt(50)) << "holds against evidence";
}

TEST_F(RegionPaintingTest, SplitsARegion_WhenMostOfItLiesBeyondTheImage) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(50), regionAt(70)}}));
  const RegionId painted = regionAt(30), large = regionAt(50);
  ASSERT_TRUE(paint(painted, {.added = {20, 48}, .image_end = 48}));
  EXPECT_EQ(regionAt(42), painted);
  EXPECT_EQ(regionAt(70), large) << "the image shows nothing of it";
}

TEST_F(RegionPaintingTest, LeavesSurfaceThatLiesElsewhere_WithItsRegion) {
  map_.setRange(fragments_[1], 65, 80);
  map_.disconnect(60);
  const std::vector<RegionId> before = all();
  ASSERT_EQ(before[3], before[1]);
  const auto outcome = paint(before[0], {.added = {20, 34}, .image_end = 60});
  ASSERT_TRUE(outcome) << outcome.error().message();
  for (int x = 20; x < 32; ++x) EXPECT_EQ(regionAt(x), before[0]) << x;
  for (int x = 36; x < 40; ++x) EXPECT_EQ(regionAt(x), before[1]) << x;
  for (int x = 65; x < 80; ++x) EXPECT_EQ(regionAt(x), before[1]) << x << ": not seen, not connected";
  ASSERT_TRUE(editor_.undo());
  for (int x = 20; x < 40; ++x) EXPECT_EQ(regionAt(x), before[1]) << x;
}

TEST_F(RegionPaintingTest, GivesWhatWasPaintedOutToItsSurroundings) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  const RegionId painted = regionAt(10), beside = regionAt(50);
  const auto outcome = paint(painted, {.removed = {25, 40}, .around = {beside}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  for (int x = 0; x < 22; ++x) EXPECT_EQ(regionAt(x), painted) << x;
  for (int x = 28; x < 60; ++x) EXPECT_EQ(regionAt(x), beside) << x << ": one plain surface";
}

TEST_F(RegionPaintingTest, MakesANewRegion_WhenAnEdgeOfColorSurroundsWhatWasPaintedOut) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  map_.color(26, 40);
  const RegionId painted = regionAt(10), beside = regionAt(50);
  const auto outcome = paint(painted, {.removed = {26, 40}, .around = {beside}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  const RegionId created = regionAt(33);
  EXPECT_NE(created, painted);
  EXPECT_NE(created, beside);
  EXPECT_EQ(regionAt(10), painted);
  EXPECT_THAT(outcome->events.parted, Contains(std::pair(painted, created)));
  EXPECT_EQ(editor_.log().entries().back().effect.created, std::vector{created});
}

TEST_F(RegionPaintingTest, KeepsTheRegion_WhenAllOfItWasPaintedOut) {
  const auto before = table_.regions();
  ASSERT_TRUE(paint(regionAt(30), {.removed = {15, 45}, .around = {regionAt(10)}}));
  EXPECT_EQ(table_.regions(), before) << "only the image changes";
}

TEST_F(RegionPaintingTest, OneUndoRestoresAllRegions) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  map_.color(0, 10);
  const std::vector<RegionId> before = all();
  const auto labels = [&] {
    std::vector<RegionId> by_column;
    for (int x = 0; x < 80; ++x) by_column.push_back(regionAt(x));
    return by_column;
  };
  const std::vector<RegionId> at_first = labels();
  ASSERT_TRUE(paint(before[0], {.added = {42, 70}, .removed = {0, 10}}));
  const std::vector<RegionId> painted = labels();
  EXPECT_NE(painted, at_first);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(labels(), at_first);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(labels(), painted);
  ASSERT_TRUE(editor_.undo());
  ASSERT_TRUE(editor_.undo());
  EXPECT_NE(regionAt(10), regionAt(30));
}

TEST_F(RegionPaintingTest, UndoLeavesFragments_ThatFramesAddedToOtherRegions) {
  const RegionId painted = regionAt(30), beside = regionAt(50);
  ASSERT_TRUE(paint(painted, {.removed = {30, 40}, .around = {beside}}));
  ASSERT_EQ(regionAt(38), beside);
  grow(beside, 80);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(38), painted);
  EXPECT_EQ(regionAt(90), beside);
}

TEST_F(RegionPaintingTest, ChangesNoRegion_WithoutASurface) {
  const auto before = table_.regions();
  Operation operation{.kind = OperationKind::paint, .regions = {regionAt(30)}};
  operation.correction = MaskCorrection{.added = {80, 10, {0, 1}}, .removed = {80, 10, {}}};
  ASSERT_TRUE(apply(operation));
  EXPECT_EQ(table_.regions(), before);
  EXPECT_EQ(editor_.log().entries().back().effect.anchor, fragments_[1]);
  EXPECT_EQ(editor_.log().entries().back().operation, operation);
}

class NewRegionPaintingTest : public RegionPaintingTest {
 protected:
  /// Paints a new region on `under`.
  Result<RegionEditor::Outcome> paintNew(RegionId under, const Painting& painting) {
    Operation operation{.kind = OperationKind::paint, .regions = {under}};
    operation.correction =
        MaskCorrection{.added = {80, 10, {0, 1}}, .removed = {80, 10, {}}, .makes_region = true};
    const PaintedSurface surface = surfaceOf(RegionId{}, painting);
    return editor_.apply(operation, params_, &surface);
  }
};

TEST_F(NewRegionPaintingTest, TakesItsSurfaceFromAllRegionsBehind) {
  const std::vector<RegionId> before = all();
  const auto outcome = paintNew(before[1], {.added = {30, 46}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  const RegionId created = outcome->regions.front();
  EXPECT_EQ(std::ranges::count(before, created), 0);
  for (int x = 32; x < 44; ++x) EXPECT_EQ(regionAt(x), created) << x;
  for (int x = 20; x < 28; ++x) EXPECT_EQ(regionAt(x), before[1]) << x;
  for (int x = 48; x < 60; ++x) EXPECT_EQ(regionAt(x), before[2]) << x;
  EXPECT_THAT(outcome->regions, Contains(before[1]));
  EXPECT_THAT(outcome->regions, Contains(before[2]));
  EXPECT_EQ(editor_.log().entries().back().effect.created, std::vector{created});
  EXPECT_EQ(table_.regionOf(editor_.log().entries().back().effect.anchor), created);
}

TEST_F(NewRegionPaintingTest, IsOneStep_ThatIsUndoneAndRedone) {
  const std::vector<RegionId> before = all();
  const auto outcome = paintNew(before[1], {.added = {30, 46}});
  ASSERT_TRUE(outcome);
  ASSERT_TRUE(editor_.undo());
  for (int x = 0; x < 80; ++x) EXPECT_EQ(regionAt(x), before[static_cast<std::size_t>(x / 20)]) << x;
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(38), outcome->regions.front());
  EXPECT_EQ(regionAt(43), outcome->regions.front());
}

TEST_F(NewRegionPaintingTest, IsRefused_WhenItWouldBeAllOfARegion) {
  const std::vector<RegionId> before = all();
  const auto refused = paintNew(before[1], {.added = {20, 40}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("all of region " + std::to_string(before[1].value)));
  EXPECT_EQ(all(), before);
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(NewRegionPaintingTest, IsRefused_WithoutASurface) {
  EXPECT_FALSE(paintNew(regionAt(30), {}));
  Operation alone{.kind = OperationKind::paint, .regions = {regionAt(30)}};
  alone.correction = MaskCorrection{.added = {80, 10, {0, 1}}, .removed = {80, 10, {}}, .makes_region = true};
  EXPECT_FALSE(apply(alone));
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionPaintingTest, TakingAPaintingAwayLeavesTheRegions) {
  const auto before = table_.regions();
  Operation unpaint{.kind = OperationKind::unpaint, .regions = {regionAt(30)}};
  unpaint.correction = MaskCorrection{.added = {80, 10, {}}, .removed = {80, 10, {}}};
  ASSERT_TRUE(apply(unpaint));
  EXPECT_EQ(table_.regions(), before);
  EXPECT_EQ(editor_.log().entries().back().effect.anchor, fragments_[1]);
}

TEST_F(RegionPaintingTest, RefusesAPainting_WithoutPixels) {
  Operation operation{.kind = OperationKind::paint, .regions = {regionAt(30)}};
  operation.correction = MaskCorrection{.added = {80, 10, {}}, .removed = {80, 10, {}}};
  const auto refused = apply(operation);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("Nothing is painted"));
  operation.correction.reset();
  EXPECT_FALSE(apply(operation));
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST(OperationLog, ForgetsTheAnchor_WhenItsFragmentIsFreed) {
  OperationLog log;
  log.add({.kind = OperationKind::paint, .regions = {RegionId{1}}},
          {.moves = {}, .constraints = {}, .notes = {}, .anchor = FragmentId{7}});
  log.forget(FragmentId{7});
  EXPECT_FALSE(log.entries().front().effect.anchor);
}

}  // namespace
}  // namespace scantrove::test
