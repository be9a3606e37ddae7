#include "core/exchange/coco_rle.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/dataset/coco_reader.h"

namespace scantrove::test {
namespace {

using Runs = std::vector<std::uint32_t>;

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

// Examples from the comment at the head of COCO's mask.py.
TEST(CocoRle, RunsFollowColumnsAndBeginOutside) {
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(7, 1) << 0, 0, 1, 1, 1, 0, 1)), (Runs{2, 3, 1, 1}));
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(7, 1) << 1, 1, 1, 1, 1, 1, 0)), (Runs{0, 6, 1}));
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(2, 3) << 0, 1, 0, 1, 1, 0)), (Runs{1, 3, 2}));
  EXPECT_EQ(runsOf(cv::Mat::zeros(4, 5, CV_8UC1)), (Runs{20}));
}

// Letters hold 6 bits from 48 ('0') on. 245 = 7 * 32 + 21: 21 + 32 ("more") is 'e', then '7'. 35 = 32 + 3:
// 'S', '1'. From the fourth run on, letters encode the difference to the run two before: 5 - 5 = 0; 1 - 3 =
// -2 is 30: 'N'. 16 alone would read as a sign, so a letter follows: 16 + 32 is '`', then '0'.
TEST(CocoRle, EncodesKnownRuns) {
  EXPECT_EQ(encodeRuns({0, 6, 1}), "061");
  EXPECT_EQ(encodeRuns({2, 3, 1, 1}), "231N");
  EXPECT_EQ(encodeRuns({245, 5, 35, 5}), "e75S10");
  EXPECT_EQ(encodeRuns({16}), "`0");
  EXPECT_EQ(encodeRuns({15, 31}), "?o0");
}

TEST(CocoRle, DecodesToTheSameMask_WithCocosAlgorithm) {
  std::mt19937 random(3);
  for (const double density : {0.0, 0.001, 0.1, 0.5, 0.99, 1.0}) {
    cv::Mat mask(53, 97, CV_8UC1);
    std::bernoulli_distribution inside(density);
    std::generate(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(),
                  [&] { return static_cast<std::uint8_t>(inside(random) ? 255 : 0); });
    const std::string text = encodeRuns(runsOf(mask));
    EXPECT_TRUE(same(decodedLikeCoco(text, 53, 97), mask)) << density;
  }
}

TEST(CocoRle, DecodesWhatItEncodes) {
  for (const Runs& runs : {Runs{0, 6, 1}, Runs{2, 3, 1, 1}, Runs{245, 5, 35, 5}, Runs{16}, Runs{15, 31},
                           Runs{}, Runs{1, 2, 2147483647, 0, 2147483647}}) {
    const auto decoded = decodeRuns(encodeRuns(runs));
    ASSERT_TRUE(decoded) << encodeRuns(runs);
    EXPECT_EQ(*decoded, runs);
  }
}

TEST(CocoRle, RefusesTexts_WhenTheyAreNoRuns) {
  EXPECT_FALSE(decodeRuns("0 1")) << "a letter below '0'";
  EXPECT_FALSE(decodeRuns("0\xFF")) << "a letter above 'o'";
  EXPECT_FALSE(decodeRuns("`")) << "announces another letter";
  EXPECT_FALSE(decodeRuns("N")) << "a run of -2 pixels";
  EXPECT_FALSE(decodeRuns("2310N")) << "the fifth run is 1 - 2 = -1";
  EXPECT_FALSE(decodeRuns("oooooo?")) << "a run of 2^34 - 1 pixels";
  EXPECT_FALSE(decodeRuns("ooooooooooooooooo0")) << "more letters than a number has";
}

}  // namespace
}  // namespace scantrove::test
