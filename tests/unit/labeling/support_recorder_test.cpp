#include "core/labeling/support_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace scantrove {
namespace {

constexpr Intrinsics kSupportCamera{300, 300, 159.5F, 119.5F, 320, 240};

/// The upper half of an image is segment 1, the lower one segment 2.
class HalvedFrame {
 public:
  explicit HalvedFrame(const Intrinsics& K) : half_(static_cast<std::size_t>(K.pixels()) / 2) {
    view.K = K;
    segments.width = K.width;
    segments.height = K.height;
    segments.ids.assign(2 * half_, 1);
    std::fill_n(segments.ids.begin() + static_cast<std::ptrdiff_t>(half_), half_, 2U);
    segments.areas = {0, static_cast<int>(half_), static_cast<int>(half_)};
    upper = table.newFragment();
    lower = table.newFragment();
    view.fragments.assign(2 * half_, upper);
    std::fill_n(view.fragments.begin() + static_cast<std::ptrdiff_t>(half_), half_, lower);
  }

  void record() { SupportRecorder().record(segments, view, table); }

  SegmentMap segments;
  RenderedView view;
  RegionTable table;
  FragmentId upper, lower;

 private:
  std::size_t half_;
};

TEST(SupportRecorder, CountsPixelsByTheRoleOfTheirSegment) {
  HalvedFrame frame(kSupportCamera);
  frame.segments.roles = {{}, {SegmentRole::Kind::support, 1}, {SegmentRole::Kind::carried, 1}};
  frame.record();
  constexpr float kHalf = 320 * 240 / 2;
  EXPECT_EQ(frame.table.supportPixels(frame.upper), (SupportPixels{kHalf, kHalf, 0}));
  EXPECT_EQ(frame.table.supportPixels(frame.lower), (SupportPixels{kHalf, 0, kHalf}));
  frame.segments.roles.clear();
  frame.record();
  EXPECT_EQ(frame.table.supportPixels(frame.upper), (SupportPixels{2 * kHalf, kHalf, 0})) << "none are known";
}

TEST(SupportRecorder, CountsAlikeAtEveryResolution) {
  HalvedFrame small(kSupportCamera), large(kSupportCamera.resizedTo(640, 480));
  for (HalvedFrame* frame : {&small, &large}) frame->record();
  EXPECT_EQ(large.table.supportPixels(large.upper), small.table.supportPixels(small.upper));
}

TEST(SupportRecorder, SkipsPixelsWithoutSegmentOrFragment) {
  HalvedFrame frame(kSupportCamera);
  for (std::size_t pixel = 0; pixel < frame.view.fragments.size(); ++pixel) {
    if (frame.view.fragments[pixel] == frame.upper)
      frame.segments.ids[pixel] = 0;
    else
      frame.view.fragments[pixel] = {};
  }
  frame.record();
  EXPECT_EQ(frame.table.supportPixels(frame.upper), SupportPixels());
  EXPECT_EQ(frame.table.supportPixels(frame.lower), SupportPixels());
}

TEST(SupportRecorder, KnowsNothingOfSplitFragmentsAndReusedNumbers) {
  HalvedFrame frame(kSupportCamera);
  frame.record();
  const FragmentId part = frame.table.newFragmentBeside(frame.upper);
  EXPECT_EQ(frame.table.supportPixels(part), SupportPixels());
  frame.table.free(part);
  ASSERT_EQ(frame.table.newFragment(), part);
  EXPECT_EQ(frame.table.supportPixels(part), SupportPixels());
}

}  // namespace
}  // namespace scantrove
