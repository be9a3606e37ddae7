#include <gtest/gtest.h>

#include <set>

#include "tests/support/film_sets.h"
#include "tests/support/synthetic_scan.h"

namespace scantrove {
namespace {

using test::SyntheticScan;

/// Frames of a row of books, seen by a scan whose working width is small for it.
class CloserLook : public testing::Test {
 protected:
  CloserLook() : scan_(options(), {}, true) {}

  static SyntheticOptions options() {
    SyntheticOptions options;
    options.set = test::makeBookRowSet;
    return options;
  }
  /// Calls `visit` with every 6th frame.
  void lookAgain(const std::function<void(const RgbdFrame&)>& visit) {
    SyntheticOptions some = options();
    some.stride = 6;
    const auto source = makeSyntheticSource(some);
    ASSERT_TRUE(source) << source.error().message();
    for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
         read = (*source)->next())
      visit(read.frame);
  }
  /// Of how many of the seven books a region of `table` covers more than half in the last such frame
  /// (intersection over union).
  int booksThatAreRegions(const RegionTable& table) {
    int books = 0;
    lookAgain([&](const RgbdFrame& frame) {
      const ScanPipeline::SeenAgain seen = scan_.pipeline().seeAgain(frame, *frame.T_world_camera);
      cv::Mat truth;
      cv::resize(frame.instances, truth, {seen.K.width, seen.K.height}, 0, 0, cv::INTER_NEAREST);
      truth.convertTo(truth, CV_32S);
      books = 0;
      for (int i = 0; i < 7; ++i) {
        const int book = scan_.source().scene().find("book " + std::to_string(i));
        std::map<RegionId, int> all, shared;
        int visible = 0;
        for (std::size_t at = 0; at < seen.result.regions.fragments.size(); ++at) {
          const RegionId region = table.regionOf(seen.result.regions.fragments[at]);
          const bool is_book = truth.ptr<int>()[at] == book;
          ++all[region];
          visible += is_book ? 1 : 0;
          if (is_book && region) ++shared[region];
        }
        books += std::ranges::any_of(
                     shared,
                     [&](const auto& of) { return of.second > 0.5 * (visible + all[of.first] - of.second); })
                     ? 1
                     : 0;
      }
    });
    return books;
  }

  SyntheticScan scan_;
};

// Seen: 3 of them before, all seven after.
TEST_F(CloserLook, PartsWhatIsNarrow) {
  scan_.run();
  const RegionTable& table = scan_.pipeline().regionTable();
  const int before = booksThatAreRegions(table);
  EXPECT_LE(before, 4) << "the scan alone does it: the test shows nothing";
  lookAgain([&](const RgbdFrame& frame) {
    ASSERT_TRUE(scan_.pipeline().segmentCloser(frame, *frame.T_world_camera));
  });
  EXPECT_GE(booksThatAreRegions(table), 6);
}

}  // namespace
}  // namespace scantrove
