#include "core/tracking/descriptor_bits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "core/tracking/feature_matching.h"

namespace scantrove {
namespace {

cv::Mat randomDescriptors(int count, int most, std::uint64_t seed) {
  cv::Mat rows(count, 32, CV_8UC1);
  cv::RNG(seed).fill(rows, cv::RNG::UNIFORM, 0, most);
  return rows;
}

TEST(CountDifferentBits, EqualsTheBitwiseCount) {
  const cv::Mat rows = randomDescriptors(50, 256, 7);
  const std::vector<Descriptor> descriptors = descriptorsOf(rows);
  ASSERT_EQ(descriptors.size(), 50U);
  std::vector<int> bits(descriptors.size());
  countDifferentBits(descriptors[3], descriptors, bits);
  for (int row = 0; row < rows.rows; ++row) {
    int expected = 0;
    for (int byte = 0; byte < 32; ++byte) {
      for (int bit = 0; bit < 8; ++bit)
        expected += ((rows.at<std::uint8_t>(3, byte) ^ rows.at<std::uint8_t>(row, byte)) >> bit) & 1;
    }
    EXPECT_EQ(bits[static_cast<std::size_t>(row)], expected) << row;
  }
  EXPECT_EQ(bits[3], 0);
}

TEST(DescriptorsOf, IsEmpty_WithoutRows) {
  EXPECT_TRUE(descriptorsOf(cv::Mat()).empty());
  countDifferentBits(Descriptor{}, {}, {});
}

TEST(MatchAll, EqualsOpenCv_WithManyTies) {
  // Bytes of 0 to 2 give many ties, and differences of at most 64 of 256 bits.
  for (const std::uint64_t seed : {1, 2, 3}) {
    const cv::Mat features = randomDescriptors(300, 3, seed);
    Landmarks landmarks;
    landmarks.descriptors = randomDescriptors(200, 3, seed + 100);
    landmarks.points_world.resize(200);
    std::vector<cv::DMatch> expected;
    cv::BFMatcher(cv::NORM_HAMMING, true).match(features, landmarks.descriptors, expected);
    const std::vector<FeatureMatch> found = matchAll(features, landmarks);
    ASSERT_FALSE(expected.empty());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].feature, expected[i].queryIdx);
      EXPECT_EQ(found[i].landmark, expected[i].trainIdx);
      EXPECT_EQ(found[i].bits, static_cast<int>(expected[i].distance));
    }
  }
}

}  // namespace
}  // namespace scantrove
