#include "core/dataset/coco_rle.h"

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kBits = 5;
constexpr std::int64_t kLowBits = 31, kSignBit = 16, kMoreBit = 32;
constexpr char kFirstLetter = 48;

}  // namespace

std::vector<std::uint32_t> runsOf(const cv::Mat& mask) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  std::vector<std::uint32_t> runs;
  std::uint32_t length = 0;
  bool is_inside = false;
  for (int x = 0; x < mask.cols; ++x) {
    for (int y = 0; y < mask.rows; ++y, ++length) {
      if ((mask.at<std::uint8_t>(y, x) != 0) == is_inside) continue;
      runs.push_back(length);
      length = 0;
      is_inside = !is_inside;
    }
  }
  runs.push_back(length);
  return runs;
}

std::string encodeRuns(const std::vector<std::uint32_t>& runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::int64_t value = runs[i];
    if (i > 2) value -= runs[i - 2];
    for (bool more = true; more;) {
      std::int64_t letter = value & kLowBits;
      value >>= kBits;  // keeps the sign
      more = (letter & kSignBit) != 0 ? value != -1 : value != 0;
      if (more) letter |= kMoreBit;
      text += static_cast<char>(letter + kFirstLetter);
    }
  }
  return text;
}

}  // namespace scantrove
