#include "core/exchange/coco_rle.h"

#include <limits>
#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kBits = 5;
constexpr std::int64_t kLowBits = 31, kSignBit = 16, kMoreBit = 32;
constexpr char kFirstLetter = 48;
constexpr std::int64_t kLastLetter = 63;
/// A difference of two 31-bit runs has 32 bits with its sign.
constexpr int kMaxShift = 30;

}  // namespace

MaskRuns runsOf(const cv::Mat& mask) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  MaskRuns runs;
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

std::string encodeRuns(const MaskRuns& runs) {
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

std::optional<MaskRuns> decodeRuns(std::string_view text) {
  MaskRuns runs;
  std::int64_t value = 0;
  int shift = 0;
  for (const char character : text) {
    const std::int64_t letter = std::int64_t{character} - kFirstLetter;
    if (letter < 0 || letter > kLastLetter || shift > kMaxShift) return std::nullopt;
    value |= (letter & kLowBits) << shift;
    shift += kBits;
    if ((letter & kMoreBit) != 0) continue;
    if ((letter & kSignBit) != 0) value -= std::int64_t{1} << shift;
    if (runs.size() > 2) value += runs[runs.size() - 2];
    if (value < 0 || value > std::numeric_limits<std::int32_t>::max()) return std::nullopt;
    runs.push_back(static_cast<std::uint32_t>(value));
    value = 0;
    shift = 0;
  }
  return shift == 0 ? std::optional(std::move(runs)) : std::nullopt;
}

}  // namespace scantrove
