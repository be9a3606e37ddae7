#include "core/collection/collector_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

namespace scantrove {
namespace {

constexpr ObjectId kMug{7}, kNew{CatalogueMirror::kFirstKey};
constexpr RegionId kRegion{11}, kPart{12};

/// A state with every kind of entry.
CollectorState someState() {
  CollectorState state;
  state.catalogue = {3, CatalogueMirror::kFirstKey + 1, {{kNew, ObjectId{9}}}, {{kMug, kNew}}, {kMug}};
  state.last_event = 41;
  ObjectTrack track;
  track.centroid_world = {1, 2, 3};
  track.size_m = {0.2F, 0.1F, 0.1F};
  track.last_frame = 5;
  track.frames_empty = 2;
  track.views.keep({0, 0, 1});
  state.tracks = {{{kNew, track}}, {{kRegion, kNew}, {kPart, kMug}}, {kMug}};
  RecognitionHistory::Tally tally;
  tally.attempts = 3;
  tally.last_frame = 4;
  tally.votes[kMug] = {2, true};
  state.recognizer.history = RecognitionHistory({{RegionSet{kRegion, kPart}, tally}});
  state.recognizer.returned = {kMug};
  state.recognizer.appeared[kNew][kMug] = 1;
  state.recognizer.comparisons[kNew] = 2;
  state.requests = {{{kPart, {"part", "cups"}}}, {{kPart, kMug}}, {kNew}};
  state.identities.mismatches[RegionSet{kRegion}] = {kMug, 4, 6};
  state.identities.replaced_by[kMug] = kNew;
  state.identities.seen_together = {{kMug, kNew}};
  state.identities.complete[RegionSet{kRegion}] = 8;
  StoredView view;
  view.object = kNew;
  view.frame_index = 6;
  view.intrinsics = Intrinsics{50, 51, 31.5F, 23.5F, 64, 48};
  view.image_px = {8, 6};
  view.box_px = {2, 1, 3, 2};
  view.mask = cv::Mat(2, 3, CV_8UC1, cv::Scalar(255));
  view.z_m = cv::Mat(2, 3, CV_32FC1, cv::Scalar(1.5));
  view.direction = {0, 0, 1};
  view.diagonal_m = 0.3F;
  view.quality = {1234.5F, 0.0625F, 0.9375F, 0.15625F};
  view.is_of_removed = true;
  state.views = {view};
  state.is_refining = true;
  state.frame = 77;
  return state;
}

/// Removes what version 4 added: the class after the name "part", a size of two words and four letters.
void removeClass(std::vector<std::uint32_t>& memory) {
  const auto name = std::ranges::find(memory, std::bit_cast<std::uint32_t>(std::array{'p', 'a', 'r', 't'}));
  ASSERT_NE(name, memory.end());
  memory.erase(name + 1, name + 4);
}

TEST(CollectorMemory, StateIsTheSame_WhenItIsReadAgain) {
  const std::vector<std::uint32_t> memory = collectorMemory(someState());
  const std::optional<CollectorState> read = collectorStateFrom(memory);
  ASSERT_TRUE(read);
  EXPECT_EQ(collectorMemory(*read), memory);
  EXPECT_EQ(read->catalogue.ids.at(kNew), ObjectId{9});
  EXPECT_EQ(read->tracks.tracks.at(kNew).frames_empty, 2);
  EXPECT_EQ(read->tracks.object_of_region.at(kPart), kMug);
  EXPECT_EQ(read->recognizer.history.attempts(RegionSet{kRegion, kPart}), 3);
  EXPECT_EQ(read->requests.pending.at(kPart), (GivenName{"part", "cups"}));
  EXPECT_EQ(read->identities.mismatches.at(RegionSet{kRegion}).count, 4);
  ASSERT_EQ(read->views.size(), 1U);
  EXPECT_EQ(read->views[0].box_px, cv::Rect(2, 1, 3, 2));
  EXPECT_FLOAT_EQ(read->views[0].z_m.at<float>(1, 2), 1.5F);
  EXPECT_TRUE(read->views[0].is_of_removed);
  EXPECT_EQ(read->views[0].intrinsics, someState().views[0].intrinsics);
  EXPECT_FLOAT_EQ(read->views[0].quality.pixels, 1234.5F);
  EXPECT_FLOAT_EQ(read->views[0].quality.hidden, 0.15625F);
  EXPECT_TRUE(read->is_refining);
  EXPECT_FALSE(read->is_last_pass);
  EXPECT_EQ(read->frame, 77);
}

TEST(CollectorMemory, StateOfTheFirstVersionIsRead_WithoutTheQualityOfViews) {
  CollectorState state = someState();
  state.views[0].box_px = {2, 1, 2, 2};
  state.views[0].mask = cv::Mat(2, 2, CV_8UC1, cv::Scalar(255));  // whole words
  state.views[0].z_m = cv::Mat(2, 2, CV_32FC1, cv::Scalar(1.5));
  std::vector<std::uint32_t> memory = collectorMemory(state);
  ASSERT_EQ(memory[0], 4U);
  memory[0] = 1;
  removeClass(memory);
  const auto quality = std::ranges::find(memory, std::bit_cast<std::uint32_t>(1234.5F));
  ASSERT_NE(quality, memory.end());
  memory.erase(quality, quality + 10);  // four figures of the quality, six of the intrinsics
  const std::optional<CollectorState> read = collectorStateFrom(memory);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->views.size(), 1U);
  EXPECT_FLOAT_EQ(read->views[0].quality.pixels, 4) << "of the mask";
  EXPECT_EQ(read->views[0].quality.sharpness, 0);
  EXPECT_FALSE(read->views[0].intrinsics);
  EXPECT_EQ(read->frame, 77);
}

TEST(CollectorMemory, NothingIsRead_WhenWordsAreMissingOrLeftOver) {
  std::vector<std::uint32_t> memory = collectorMemory(someState());
  for (std::size_t size = 0; size < memory.size(); ++size)
    EXPECT_FALSE(collectorStateFrom(std::span(memory).first(size))) << size;
  memory.push_back(0);
  EXPECT_FALSE(collectorStateFrom(memory));
}

TEST(CollectorMemory, NothingIsRead_WhenAViewLiesOutsideOfItsImage) {
  CollectorState state = someState();
  state.views[0].box_px.x = 7;
  EXPECT_FALSE(collectorStateFrom(collectorMemory(state)));
}

TEST(CollectorMemory, StateOfTheSecondVersionIsRead_WithoutIntrinsicsOfViews) {
  CollectorState state = someState();
  state.views[0].box_px = {2, 1, 2, 2};
  state.views[0].mask = cv::Mat(2, 2, CV_8UC1, cv::Scalar(255));  // whole words
  state.views[0].z_m = cv::Mat(2, 2, CV_32FC1, cv::Scalar(1.5));
  std::vector<std::uint32_t> memory = collectorMemory(state);
  memory[0] = 2;
  removeClass(memory);
  const auto quality = std::ranges::find(memory, std::bit_cast<std::uint32_t>(1234.5F));
  ASSERT_NE(quality, memory.end());
  memory.erase(quality + 4, quality + 10);
  const std::optional<CollectorState> read = collectorStateFrom(memory);
  ASSERT_TRUE(read);
  EXPECT_FLOAT_EQ(read->views[0].quality.pixels, 1234.5F);
  EXPECT_FALSE(read->views[0].intrinsics);
  EXPECT_EQ(read->frame, 77);
}

TEST(CollectorMemory, StateOfTheThirdVersionIsRead_WithoutClasses) {
  std::vector<std::uint32_t> memory = collectorMemory(someState());
  memory[0] = 3;
  removeClass(memory);
  const std::optional<CollectorState> read = collectorStateFrom(memory);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->requests.pending.at(kPart), GivenName{"part"});
  EXPECT_EQ(read->frame, 77);
}

TEST(CollectorMemory, NothingIsRead_WhenACameraIsNone) {
  CollectorState state = someState();
  state.views[0].intrinsics->fx = 0;
  EXPECT_FALSE(collectorStateFrom(collectorMemory(state)));
  state.views[0].intrinsics = Intrinsics{50, 50, 32, 24, 64, -48};
  EXPECT_FALSE(collectorStateFrom(collectorMemory(state)));
}

TEST(CollectorMemory, NothingIsRead_WhenANumberIsNotFinite) {
  CollectorState state = someState();
  state.tracks.tracks.at(kNew).centroid_world.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(collectorStateFrom(collectorMemory(state)));
}

}  // namespace
}  // namespace scantrove
