#include "core/dataset/coco_rle.h"

#include <gtest/gtest.h>

#include <random>

namespace scantrove {
namespace {

using Runs = std::vector<std::uint32_t>;

/// Word for word what COCO's own reader does: letters to runs, runs to pixels, column by column.
cv::Mat decodedByTheBook(const std::string& text, int height, int width) {
  std::vector<long> counts;
  std::size_t p = 0;
  while (p < text.size()) {
    long x = 0;
    int k = 0;
    bool more = true;
    while (more) {
      const long c = text.at(p) - 48;
      x |= (c & 0x1f) << 5 * k;
      more = (c & 0x20) != 0;
      ++p;
      ++k;
      if (!more && (c & 0x10) != 0) x |= -1L << 5 * k;
    }
    if (counts.size() > 2) x += counts[counts.size() - 2];
    counts.push_back(x);
  }
  std::vector<std::uint8_t> pixels;
  for (std::size_t i = 0; i < counts.size(); ++i)
    pixels.insert(pixels.end(), static_cast<std::size_t>(counts[i]), i % 2 == 1 ? 255 : 0);
  EXPECT_EQ(pixels.size(), static_cast<std::size_t>(height * width));
  cv::Mat columns(width, height, CV_8UC1, pixels.data());
  return columns.t();
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

// Runs and masks of the comment at the head of COCO's mask.py.
TEST(CocoRle, RunsGoDownTheColumnsAndBeginOutside) {
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(7, 1) << 0, 0, 1, 1, 1, 0, 1)), (Runs{2, 3, 1, 1}));
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(7, 1) << 1, 1, 1, 1, 1, 1, 0)), (Runs{0, 6, 1}));
  EXPECT_EQ(runsOf((cv::Mat_<std::uint8_t>(2, 3) << 0, 1, 0, 1, 1, 0)), (Runs{1, 3, 2}));
  EXPECT_EQ(runsOf(cv::Mat::zeros(4, 5, CV_8UC1)), (Runs{20}));
}

// By hand: 6 bits a letter from 48 ('0') on. 245 = 7 * 32 + 21: 21 + 32 ("more") is 'e', then '7'. 35 = 32 +
// 3: 'S', '1'. The fourth run and all behind it as differences to that two before: 5 - 5 = 0; 1 - 3 = -2 is
// 30: 'N'. 16 would read as a sign, so a letter follows: 16 + 32 is '`', then '0'.
TEST(CocoRle, LettersAreAsComputedByHand) {
  EXPECT_EQ(encodeRuns({0, 6, 1}), "061");
  EXPECT_EQ(encodeRuns({2, 3, 1, 1}), "231N");
  EXPECT_EQ(encodeRuns({245, 5, 35, 5}), "e75S10");
  EXPECT_EQ(encodeRuns({16}), "`0");
  EXPECT_EQ(encodeRuns({15, 31}), "?o0");
}

TEST(CocoRle, AnyMaskComesBackByTheBook) {
  std::mt19937 random(3);
  for (const double density : {0.0, 0.001, 0.1, 0.5, 0.99, 1.0}) {
    cv::Mat mask(53, 97, CV_8UC1);
    std::bernoulli_distribution inside(density);
    std::generate(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(),
                  [&] { return static_cast<std::uint8_t>(inside(random) ? 255 : 0); });
    const std::string text = encodeRuns(runsOf(mask));
    EXPECT_TRUE(same(decodedByTheBook(text, 53, 97), mask)) << density;
    const auto decoded = decodeRuns(text, mask.size());
    ASSERT_TRUE(decoded);
    EXPECT_TRUE(same(*decoded, mask)) << density;
  }
}

TEST(CocoRle, DamagedTextIsRefused) {
  EXPECT_FALSE(decodeRuns("06", {1, 7}));    // too short
  EXPECT_FALSE(decodeRuns("0616", {1, 7}));  // too long
  EXPECT_FALSE(decodeRuns("e", {1, 7}));     // breaks off
  EXPECT_FALSE(decodeRuns("N", {1, 7}));     // -2 pixels
  EXPECT_FALSE(decodeRuns("oooooooooooooooo0", {1, 7}));
}

}  // namespace
}  // namespace scantrove
