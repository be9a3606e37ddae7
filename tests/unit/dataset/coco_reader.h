#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace scantrove::test {

/// Follows COCO's own reader step by step: letters to runs, runs to pixels, column by column.
inline cv::Mat decodedLikeCoco(const std::string& text, int height, int width) {
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

}  // namespace scantrove::test
