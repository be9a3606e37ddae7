#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/image/png_decoder.h"

namespace scantrove {
namespace {

/// Rows of noise, slopes, steps and constants, so that an encoder chooses every filter.
cv::Mat variedDepth(int width, int height) {
  cv::Mat depth(height, width, CV_16UC1);
  cv::theRNG().state = 7;
  cv::randu(depth, 0, 65536);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (y % 4 != 0) {
        depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(y % 4 == 1   ? 500 + 7 * x + 3 * y
                                                                   : y % 4 == 2 ? (x < width / 2 ? 900 : 2300)
                                                                                : 1234);
      }
    }
  }
  return depth;
}

std::vector<uchar> encode(const cv::Mat& image, int strategy = cv::IMWRITE_PNG_STRATEGY_DEFAULT) {
  std::vector<uchar> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 6, cv::IMWRITE_PNG_STRATEGY, strategy});
  return bytes;
}

TEST(DecodeGrayPng, ReadsBackEqual_ForEverySizeAndFilter) {
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(1, 1), cv::Size(3, 5), cv::Size(640, 480)}) {
    for (const int strategy : {cv::IMWRITE_PNG_STRATEGY_DEFAULT, cv::IMWRITE_PNG_STRATEGY_FILTERED,
                               cv::IMWRITE_PNG_STRATEGY_RLE, cv::IMWRITE_PNG_STRATEGY_FIXED}) {
      const cv::Mat depth = variedDepth(size.width, size.height);
      const std::vector<uchar> bytes = encode(depth, strategy);
      const auto decoded = decodeGrayPng(bytes, "test");
      ASSERT_TRUE(decoded) << decoded.error().message();
      ASSERT_EQ(decoded->type(), CV_16UC1);
      ASSERT_EQ(decoded->size(), size);
      EXPECT_EQ(cv::norm(*decoded, depth, cv::NORM_INF), 0) << size << " strategy " << strategy;
    }
  }
}

TEST(DecodeGrayPng, GivesNoWrongPixels_WhenBytesAreDamaged) {
  const cv::Mat depth = variedDepth(32, 24);
  const std::vector<uchar> bytes = encode(depth);
  for (std::size_t i = 33; i < bytes.size(); ++i) {  // after the header
    std::vector<uchar> damaged = bytes;
    damaged[i] ^= 0x10;
    const auto decoded = decodeGrayPng(damaged, "test");
    EXPECT_TRUE(!decoded || cv::norm(*decoded, depth, cv::NORM_INF) == 0) << "byte " << i;
    const auto cut = decodeGrayPng({bytes.data(), i}, "test");
    EXPECT_TRUE(!cut || cv::norm(*cut, depth, cv::NORM_INF) == 0) << "length " << i;
  }
}

}  // namespace
}  // namespace scantrove
