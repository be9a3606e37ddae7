#include "ui/panels/regions_in_picture.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace scantrove {
namespace {

/// What one pass collects of a region.
struct PixelSum {
  std::int64_t x = 0, y = 0, count = 0;
  int left = std::numeric_limits<int>::max(), top = std::numeric_limits<int>::max(), right = -1, bottom = -1;
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();  ///< squared, times count squared
  cv::Point anchor_px;
};

/// Calls `visit(sum, x, y)` for each pixel of the regions.
template <class Visit>
void visitPixels(const cv::Mat& ids, std::map<int, PixelSum>& sums, const Visit& visit) {
  for (int y = 0; y < ids.rows; ++y) {
    const auto* row = ids.ptr<int>(y);
    int known = 0;  // neighboring pixels mostly show one region
    PixelSum* sum = nullptr;
    for (int x = 0; x < ids.cols; ++x) {
      if (row[x] <= 0) continue;
      if (row[x] != known) {
        known = row[x];
        const auto found = sums.find(known);
        sum = found == sums.end() ? nullptr : &found->second;
      }
      if (sum != nullptr) visit(*sum, x, y);
    }
  }
}

}  // namespace

std::map<RegionId, RegionInPicture> regionsInPicture(const cv::Mat& ids, const std::set<RegionId>& regions,
                                                     int least) {
  std::map<RegionId, RegionInPicture> found;
  if (ids.empty() || regions.empty()) return found;
  std::map<int, PixelSum> sums;
  for (const RegionId region : regions) sums[static_cast<int>(region.value)] = {};
  visitPixels(ids, sums, [](PixelSum& sum, int x, int y) {
    sum.x += x;
    sum.y += y;
    ++sum.count;
    sum.left = std::min(sum.left, x);
    sum.right = std::max(sum.right, x);
    sum.top = std::min(sum.top, y);
    sum.bottom = std::max(sum.bottom, y);
  });
  visitPixels(ids, sums, [](PixelSum& sum, int x, int y) {
    const std::int64_t dx = sum.count * x - sum.x, dy = sum.count * y - sum.y;
    const std::int64_t away = (dx * dx + dy * dy) / sum.count;
    if (away >= sum.nearest) return;
    sum.nearest = away;
    sum.anchor_px = {x, y};
  });
  for (const auto& [region, sum] : sums) {
    if (sum.count < std::max(1, least)) continue;
    const cv::Rect box(sum.left, sum.top, sum.right - sum.left + 1, sum.bottom - sum.top + 1);
    found[RegionId{static_cast<std::uint32_t>(region)}] = {sum.anchor_px, box, static_cast<int>(sum.count)};
  }
  return found;
}

}  // namespace scantrove
