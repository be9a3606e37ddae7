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

Result<cv::Mat> decodeRuns(std::string_view text, cv::Size size) {
  const auto damaged = [] { return fail("A run-length encoded mask is damaged."); };
  std::vector<std::int64_t> runs;
  for (std::size_t at = 0; at < text.size();) {
    std::int64_t value = 0;
    for (int shift = 0;; shift += kBits) {
      if (at == text.size() || shift > 8 * kBits) return damaged();
      const std::int64_t letter = text[at++] - kFirstLetter;
      value |= (letter & kLowBits) << shift;
      if ((letter & kMoreBit) != 0) continue;
      if ((letter & kSignBit) != 0) value |= -1LL << (shift + kBits);
      break;
    }
    runs.push_back(runs.size() > 2 ? value + runs[runs.size() - 2] : value);
  }
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  std::int64_t at = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i] < 0 || at + runs[i] > static_cast<std::int64_t>(size.area())) return damaged();
    for (const std::int64_t end = at + runs[i]; at < end; ++at) {
      if (i % 2 == 1)
        mask.at<std::uint8_t>(static_cast<int>(at % size.height), static_cast<int>(at / size.height)) = 255;
    }
  }
  if (at != static_cast<std::int64_t>(size.area())) return damaged();
  return mask;
}

}  // namespace scantrove
