#include <gtest/gtest.h>

#include <map>

#include "tests/support/synthetic_scan.h"
#include "tests/support/test_scenes.h"

namespace scantrove {
namespace {

using test::SyntheticScan;

/// A scan of a row of books with a low working width, and every 6th of its frames in full resolution.
class FullResolutionSegmentationTest : public testing::Test {
 protected:
  FullResolutionSegmentationTest() : scan_(options(), params(), PoseUse::given) {
    SyntheticOptions full_resolution = options();
    full_resolution.stride = 6;
    const auto source = makeSyntheticSource(full_resolution).value();
    for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next())
      frames_.push_back(std::move(read.frame));
  }
  static SyntheticOptions options() {
    SyntheticOptions options;
    options.recipe = test::makeBookRowScene;
    return options;
  }
  static MappingParams params() {
    MappingParams params;
    params.fusion.working_width = 240;  // at 320 the scan alone separates 6 of them
    return params;
  }
  /// The number of books whose best region has an intersection over union above 0.5 in the last frame.
  int booksThatAreRegions() {
    const RgbdFrame& frame = frames_.back();
    const FrameResult seen = scan_.pipeline().observe(frame, *frame.T_world_camera);
    cv::Mat resized;
    cv::resize(frame.instances, resized, {seen.view.K.width, seen.view.K.height}, 0, 0, cv::INTER_NEAREST);
    const cv::Mat1i truth = resized;
    std::map<RegionId, int> all;
    for (const RegionId region : seen.view.regions) ++all[region];
    int books = 0;
    for (int i = 0; i < 7; ++i) {
      const int book = scan_.source().scene().find("book " + std::to_string(i));
      std::map<RegionId, int> shared;
      for (std::size_t at = 0; at < seen.view.regions.size(); ++at) {
        if (truth(static_cast<int>(at)) == book) ++shared[seen.view.regions[at]];
      }
      const int visible = cv::countNonZero(truth == book);
      const bool is_region = std::ranges::any_of(shared, [&](const auto& part) {
        return part.first && part.second > 0.5 * (visible + all[part.first] - part.second);
      });
      books += is_region ? 1 : 0;
    }
    return books;
  }

  SyntheticScan scan_;
  std::vector<RgbdFrame> frames_;
};

TEST_F(FullResolutionSegmentationTest, SeparatesNarrowObjects) {
  scan_.run();
  EXPECT_LE(booksThatAreRegions(), 4) << "the scan alone separates them: the test shows nothing";
  for (const RgbdFrame& frame : frames_)
    ASSERT_TRUE(scan_.pipeline().segmentCloser(frame, *frame.T_world_camera));
  EXPECT_GE(booksThatAreRegions(), 6);
}

}  // namespace
}  // namespace scantrove
