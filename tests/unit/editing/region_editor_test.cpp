#include "core/editing/region_editor.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/labeling/graph_merger.h"
#include "core/labeling/region_partition.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A flat strip of voxels at z = 0.
class StripMap final : public EditableMap {
 public:
  void setRange(FragmentId fragment, int from, int to) {
    for (int x = from; x < to; ++x) {
      for (int y = 0; y < 10; ++y) set(x, y, fragment);
    }
  }
  float voxelSize() const override { return 0.01F; }
  std::span<const int> voxelsOfFragments() const override { return counts_; }
  std::vector<SurfaceVoxel> surfaceOf(std::span<const FragmentId> fragments,
                                      std::span<const Eigen::Vector3f>) override {
    std::vector<SurfaceVoxel> voxels;
    for (const auto& [position, fragment] : labels_) {
      if (std::ranges::find(fragments, fragment) != fragments.end())
        voxels.push_back(
            {{position.first, position.second, 0}, {0, 0, 1}, fragment, colorAt(position.first)});
    }
    return voxels;
  }
  void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) override {
    for (const Eigen::Vector3i& voxel : voxels) set(voxel.x(), voxel.y(), fragment);
  }
  FragmentId at(int x) const { return labels_.at({x, 5}); }
  /// Colours the strip green from `from` to `to` and brown elsewhere; without, it has no colours.
  void color(int from, int to) { green_ = {from, to}; }

 private:
  void set(int x, int y, FragmentId fragment) {
    FragmentId& label = labels_[{x, y}];
    counts_.resize(std::max<std::size_t>(counts_.size(), fragment.value + std::size_t{1}), 0);
    if (label) --counts_[label.value];
    ++counts_[fragment.value];
    label = fragment;
  }
  std::optional<std::array<std::uint8_t, 3>> colorAt(int x) const {
    if (!green_) return std::nullopt;
    const bool is_green = x >= green_->first && x < green_->second;
    return is_green ? std::array<std::uint8_t, 3>{80, 160, 90} : std::array<std::uint8_t, 3>{190, 150, 100};
  }
  std::optional<std::pair<int, int>> green_;
  std::map<std::pair<int, int>, FragmentId> labels_;
  std::vector<int> counts_{0};
};

/// Four fragments in a row, each a region of its own: 0 - 20, 20 - 40, 40 - 60, 60 - 80.
class RegionEditorTest : public testing::Test {
 protected:
  RegionEditorTest() {
    for (int i = 0; i < 4; ++i) {
      fragments_.push_back(table_.newFragment());
      map_.setRange(fragments_.back(), 20 * i, 20 * (i + 1));
    }
  }
  RegionId regionAt(int x) const { return table_.regionOf(map_.at(x)); }
  Result<RegionEditor::Outcome> apply(Operation operation) { return editor_.apply(operation, params_); }
  /// Updates the regions as each frame does after an operation.
  void partition() {
    RegionEvents events;
    updatePartition(fragments_, merger_.graph(), map_.voxelsOfFragments(), params_, table_, events);
  }
  /// Adds evidence of 20 frames that `a` and `b` are one object or two.
  void addEvidence(FragmentId a, FragmentId b, bool is_one) {
    FragmentContact contact;
    contact.a = a;
    contact.b = b;
    contact.length_px = 100;
    contact.bridged_px = is_one ? 100 : 0;
    contact.length_m = 0.3F;
    contact.depth_m = 1;
    contact.bends = 80;
    contact.concavity_rad = is_one ? 0.F : 0.9F;
    contact.color_shift = is_one ? 1.F : 40.F;
    contact.colors = {*contact.color_shift, *contact.color_shift};
    contact.folded = is_one ? 0.F : 1.F;
    auto& graph = const_cast<EvidenceGraph&>(merger_.graph());
    for (int frame = 0; frame < 20; ++frame) graph.between(a, b).add(contact, is_one ? 1 : 0);
  }
  /// Adds a fragment to a region, as frames do: 20 voxels wide from `from` on.
  FragmentId grow(RegionId region, int from) {
    const FragmentId fragment = table_.newFragment();
    map_.setRange(fragment, from, from + 20);
    table_.join(region, table_.regionOf(fragment));
    return fragment;
  }
  std::vector<RegionId> all() const {
    std::vector<RegionId> regions;
    for (int x = 10; x < 80; x += 20) regions.push_back(regionAt(x));
    return regions;
  }

  RegionTable table_;
  GraphMerger merger_;
  StripMap map_;
  LabelingParams params_;
  RegionEditor editor_{table_, merger_, map_};
  std::vector<FragmentId> fragments_;
};

TEST_F(RegionEditorTest, JoinHolds_AgainstEvidenceOfTwoObjects) {
  const RegionId first = regionAt(10), second = regionAt(30);
  const auto outcome = apply({.kind = OperationKind::join, .regions = {first, second}});
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->regions, ElementsAre(first));
  EXPECT_THAT(outcome->events.joined, ElementsAre(std::pair(first, second)));
  EXPECT_EQ(regionAt(30), first);
  addEvidence(fragments_[0], fragments_[1], false);
  partition();
  EXPECT_EQ(regionAt(30), regionAt(10));
}

TEST_F(RegionEditorTest, RestoresTheTables_WhenAllIsUndoneAndRedone) {
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(10)}, .name = "mug"}));
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  ASSERT_TRUE(apply({.kind = OperationKind::cut,
                     .regions = {regionAt(50)},
                     .here_world = {{0.42F, 0.05F, 0.005F}},
                     .there_world = {{0.58F, 0.05F, 0.005F}}}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(70)}}));
  const std::vector<RegionId> done = table_.regions();
  const auto notes = editor_.notes().all();
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(editor_.undo());
  EXPECT_FALSE(editor_.undo());
  EXPECT_EQ(all(), (std::vector{RegionId{1}, RegionId{2}, RegionId{3}, RegionId{4}}));
  EXPECT_EQ(regionAt(42), regionAt(58)) << "one region again";
  EXPECT_TRUE(editor_.notes().all().empty());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(editor_.redo());
  EXPECT_FALSE(editor_.redo());
  EXPECT_EQ(table_.regions(), done);
  EXPECT_EQ(editor_.notes().all(), notes);
}

TEST_F(RegionEditorTest, RedoneJoinIncludesFragments_AddedSinceTheUndo) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  ASSERT_TRUE(editor_.undo());
  grow(second, 80);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(30), first);
  EXPECT_EQ(regionAt(90), first) << "it belonged to the second region";
  EXPECT_TRUE(table_.fragmentsOf(second).empty());
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(30), second);
  EXPECT_EQ(regionAt(90), second);
  EXPECT_EQ(regionAt(10), first);
}

TEST_F(RegionEditorTest, RedoneJoinHolds_WhenItsFragmentWasFreed) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  ASSERT_TRUE(editor_.undo());
  const FragmentId grown = grow(second, 80);
  editor_.forget(fragments_[1]);  // as when no voxel has its label any more
  table_.free(fragments_[1]);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(90), first);
  EXPECT_EQ(merger_.constraintBetween(fragments_[0], grown), LinkConstraint::must_link);
}

TEST_F(RegionEditorTest, UndoneCutReturnsFragments_AddedToItsPart) {
  const RegionId region = regionAt(50);
  const auto outcome = apply({.kind = OperationKind::cut,
                              .regions = {region},
                              .here_world = {{0.42F, 0.05F, 0.005F}},
                              .there_world = {{0.58F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  const RegionId part = outcome->regions[0] == region ? outcome->regions[1] : outcome->regions[0];
  grow(part, 80);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(42), region);
  EXPECT_EQ(regionAt(58), region);
  EXPECT_EQ(regionAt(90), region) << "the part no longer exists";
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(90), part);
  EXPECT_NE(regionAt(42), regionAt(58));
}

TEST_F(RegionEditorTest, CutDividesAFragmentAndHolds_AgainstEvidenceOfOneObject) {
  const RegionId region = regionAt(50);
  const auto outcome = apply({.kind = OperationKind::cut,
                              .regions = {region},
                              .here_world = {{0.42F, 0.05F, 0.005F}},
                              .there_world = {{0.58F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  EXPECT_EQ(regionAt(41), outcome->regions[0]);
  EXPECT_EQ(regionAt(58), outcome->regions[1]);
  EXPECT_NE(outcome->regions[0], outcome->regions[1]);
  EXPECT_TRUE(outcome->regions[0] == region || outcome->regions[1] == region);
  fragments_.push_back(map_.at(41) == fragments_[2] ? map_.at(58) : map_.at(41));
  addEvidence(fragments_[2], fragments_.back(), true);
  partition();
  EXPECT_NE(regionAt(41), regionAt(58));
  // After the undo, evidence decides again.
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(41), regionAt(58));
  partition();
  EXPECT_EQ(regionAt(41), regionAt(58));
}

// Voxels under a stroke stay on its side, however near the other stroke is.
TEST_F(RegionEditorTest, CutByStrokesKeepsEachStrokeOnItsSide) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  const RegionId region = regionAt(10);
  Operation cut{.kind = OperationKind::cut, .regions = {region}};
  // Two single clicks would divide the 40 voxels in the middle.
  for (int x = 0; x <= 30; ++x)
    cut.here_world.push_back({0.01F * static_cast<float>(x) + 0.005F, 0.055F, 0.005F});
  for (int x = 34; x <= 39; ++x)
    cut.there_world.push_back({0.01F * static_cast<float>(x) + 0.005F, 0.055F, 0.005F});
  const auto outcome = apply(cut);
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  for (int x = 0; x <= 30; ++x) EXPECT_EQ(regionAt(x), outcome->regions[0]) << x;
  for (int x = 35; x <= 39; ++x) EXPECT_EQ(regionAt(x), outcome->regions[1]) << x;
  ASSERT_TRUE(editor_.undo());
  for (int x = 0; x < 40; ++x) EXPECT_EQ(regionAt(x), region) << x;
}

TEST_F(RegionEditorTest, CutByOneStrokeTakesWhatHasItsColor) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  const RegionId region = regionAt(10);
  map_.color(26, 40);
  const auto outcome =
      apply({.kind = OperationKind::cut, .regions = {region}, .here_world = {{0.33F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  for (int x = 0; x < 40; ++x) {
    if (std::abs(x - 26) <= 1) continue;
    EXPECT_EQ(regionAt(x), outcome->regions[x < 26 ? 1 : 0]) << x;
  }
  EXPECT_EQ(outcome->regions[1], region) << "the larger part keeps its identity";
  ASSERT_TRUE(editor_.undo());
  for (int x = 0; x < 40; ++x) EXPECT_EQ(regionAt(x), region) << x;
  ASSERT_TRUE(editor_.redo());
  EXPECT_NE(regionAt(10), regionAt(35));
}

TEST_F(RegionEditorTest, RefusesACutByOneStroke_WhenNothingDiffersInColor) {
  const auto before = table_.regions();
  for (const bool has_colors : {false, true}) {
    if (has_colors) map_.color(0, 80);
    const auto refused =
        apply({.kind = OperationKind::cut, .regions = {regionAt(50)}, .here_world = {{0.5F, 0.05F, 0.005F}}});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("second stroke"));
  }
  EXPECT_EQ(table_.regions(), before);
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, FinerFollowsColors_WhenThereIsNoFold) {
  const RegionId region = regionAt(50);
  EXPECT_FALSE(apply({.kind = OperationKind::finer, .regions = {region}})) << "flat, without colours";
  map_.color(50, 60);
  const auto outcome = apply({.kind = OperationKind::finer, .regions = {region}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(outcome->regions.size(), 2U);
  EXPECT_EQ(regionAt(41), regionAt(48));
  EXPECT_EQ(regionAt(52), regionAt(59));
  EXPECT_NE(regionAt(41), regionAt(59));
}

TEST_F(RegionEditorTest, RefusesACut_WhenBothPointsAreEqual) {
  const auto before = table_.regions();
  const auto refused = apply({.kind = OperationKind::cut,
                              .regions = {regionAt(50)},
                              .here_world = {{0.5F, 0.05F, 0.005F}},
                              .there_world = {{0.5F, 0.05F, 0.005F}}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("one place"));
  EXPECT_EQ(table_.regions(), before);
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, CutPartReturnsToItsOriginalRegion_WhenTheJoinIsUndone) {
  const RegionId second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), second}}));
  ASSERT_TRUE(apply({.kind = OperationKind::cut,
                     .regions = {regionAt(30)},
                     .here_world = {{0.22F, 0.05F, 0.005F}},
                     .there_world = {{0.38F, 0.05F, 0.005F}}}));
  ASSERT_NE(map_.at(21), map_.at(38));
  const std::vector<RegionId> done = table_.regions();
  ASSERT_TRUE(editor_.undo());
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(21), second);
  EXPECT_EQ(regionAt(38), second);
  ASSERT_TRUE(editor_.redo());
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(table_.regions(), done);
}

TEST_F(RegionEditorTest, SplitFragmentReturnsToItsOriginalRegion_WhenTheJoinIsUndone) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  const auto splitOff = [&](FragmentId fragment, int from, int to) {
    const FragmentId part = table_.newFragmentBeside(fragment);
    map_.setRange(part, from, to);
    editor_.splitOff(part, fragment);
    return part;
  };
  const FragmentId of_first = splitOff(fragments_[0], 0, 5), of_second = splitOff(fragments_[1], 33, 40);
  const FragmentId of_part = splitOff(of_second, 38, 40);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(table_.regionOf(of_first), first);
  EXPECT_EQ(table_.regionOf(of_second), second) << "as without the join";
  EXPECT_EQ(table_.regionOf(of_part), second);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(table_.regionOf(of_second), first);
  EXPECT_EQ(table_.regionOf(of_part), first);
}

TEST_F(RegionEditorTest, UndoRevertsOnlyTheUsersJoin_WhenFramesJoinedMore) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  addEvidence(fragments_[1], fragments_[2], true);  // evidence from frames after the join
  params_.joining_bias = 5;
  partition();
  params_.joining_bias = 0;
  ASSERT_EQ(regionAt(50), regionAt(30));
  ASSERT_TRUE(editor_.undo());
  EXPECT_NE(regionAt(10), regionAt(30));
}

TEST_F(RegionEditorTest, EvidenceDoesNotJoinNamedRegions) {
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(10)}, .name = "book"}));
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(30)}, .name = "book"}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(50)}}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(70)}}));
  for (std::size_t i = 0; i + 1 < 4; ++i) addEvidence(fragments_[i], fragments_[i + 1], true);
  params_.joining_bias = 5;
  partition();
  EXPECT_NE(regionAt(10), regionAt(30)) << "two named objects of one kind";
  EXPECT_NE(regionAt(30), regionAt(50)) << "an object and background";
  EXPECT_EQ(regionAt(50), regionAt(70)) << "background joins background";
  // A user may join them.
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  partition();
  EXPECT_EQ(regionAt(10), regionAt(30));
}

TEST_F(RegionEditorTest, CoarserJoinsTheLikelierNeighbor) {
  const RegionId region = regionAt(10);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {region, regionAt(30)}}));
  ASSERT_TRUE(editor_.undo());
  addEvidence(fragments_[0], fragments_[1], true);
  addEvidence(fragments_[1], fragments_[2], false);
  const auto coarser = apply({.kind = OperationKind::coarser, .regions = {regionAt(30)}});
  ASSERT_TRUE(coarser) << coarser.error().message();
  EXPECT_EQ(regionAt(10), regionAt(30)) << "with the likelier neighbour";
  EXPECT_NE(regionAt(50), regionAt(30));
}

TEST_F(RegionEditorTest, StoresNamesAsTheCatalogueDoes_WhenTheyHaveBlanks) {
  const RegionId region = regionAt(10);
  Operation naming{OperationKind::name, {region}, " mug ", " cup"};
  const auto outcome = apply(naming);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->operation.name, "mug") << "catalogue and session file store this name";
  EXPECT_EQ(editor_.notes().of(region).name, "mug");
  EXPECT_EQ(editor_.notes().of(region).category, "cup");
}

TEST_F(RegionEditorTest, NamingEndsBackground_UntilItIsUndone) {
  const RegionId region = regionAt(10);
  ASSERT_TRUE(apply({OperationKind::background, {region}}));
  ASSERT_TRUE(apply({OperationKind::name, {region}, "mug"}));
  EXPECT_FALSE(editor_.notes().of(region).background) << "data sets omit background";
  ASSERT_TRUE(editor_.undo());
  EXPECT_TRUE(editor_.notes().of(region).background);
}

TEST_F(RegionEditorTest, RefusesNames_WhenTheCatalogueWould) {
  const RegionId region = regionAt(10);
  for (const std::string& name :
       {std::string("two\nlines"), std::string(300, 'x'), std::string("\xFF"), std::string("12")})
    EXPECT_FALSE(apply({OperationKind::name, {region}, name}));
  EXPECT_FALSE(apply({OperationKind::name, {region}, "mug", "two\nlines"}));
  EXPECT_EQ(editor_.notes().of(region), RegionNote{});
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, RefusesOperations_WhenARegionIsUnknownOrAlone) {
  const auto refused = apply({.kind = OperationKind::name, .regions = {RegionId{77}}, .name = "x"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("77"));
  EXPECT_FALSE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(10)}}));
  EXPECT_FALSE(apply({.kind = OperationKind::coarser, .regions = {regionAt(10)}}));
}

TEST(OperationLog, KeepsUndoneOperations_WhenAnotherIsAdded) {
  OperationLog log;
  log.add({.kind = OperationKind::reject, .regions = {RegionId{1}}}, {});
  log.add({.kind = OperationKind::object, .regions = {RegionId{2}}}, {});
  EXPECT_EQ(log.undo()->number, 2);
  EXPECT_EQ(log.undo()->number, 1);
  EXPECT_EQ(log.undo(), nullptr);
  EXPECT_EQ(log.redo()->number, 1);
  log.add({.kind = OperationKind::object, .regions = {RegionId{3}}}, {});
  EXPECT_EQ(log.redo(), nullptr);
  ASSERT_EQ(log.entries().size(), 3U);
  EXPECT_EQ(log.entries()[1].state, OperationLog::State::superseded);
  EXPECT_EQ(log.entries()[2].number, 3);
  EXPECT_THAT(log.takeChanged(), ElementsAre(0, 1, 2));
  EXPECT_TRUE(log.takeChanged().empty());
}

}  // namespace
}  // namespace scantrove::test
