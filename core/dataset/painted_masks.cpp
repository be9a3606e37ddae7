#include "core/dataset/painted_masks.h"

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

bool isMaskOf(const cv::Mat& mask, const cv::Mat& regions) {
  return mask.type() == CV_8UC1 && mask.size() == regions.size();
}

void addPainted(const PaintedMask& painted, cv::Mat& regions) {
  const cv::Rect box = cv::boundingRect(painted.added);
  for (int y = box.y; y < box.br().y; ++y) {
    const auto* mask = painted.added.ptr(y);
    auto* row = regions.ptr<int>(y);
    for (int x = box.x; x < box.br().x; ++x) {
      if (mask[x] == 0) continue;
      const bool is_part =
          std::ranges::find(painted.parts, static_cast<std::uint32_t>(row[x])) != painted.parts.end();
      if (!is_part) row[x] = static_cast<int>(painted.region);
    }
  }
}

/// Components of pixels that show a region which was painted out there.
class PaintedOut {
 public:
  PaintedOut(const cv::Mat& removed, int region, cv::Mat& regions)
      : region_(region), regions_(regions), gone_((regions == region) & (removed != 0)) {
    cv::connectedComponents(gone_, components_, 4, CV_32S);
  }

  /// Gives each component the region that borders on most of it.
  void fill() {
    countBorders();
    const cv::Rect box = cv::boundingRect(gone_);
    std::map<int, int> fillings;
    for (const auto& [component, borders] : borders_) {
      const auto most = std::ranges::max_element(
          borders, {}, [](const auto& border) { return std::pair(border.second, -border.first); });
      fillings[component] = most->first;
    }
    for (int y = box.y; y < box.br().y; ++y) {
      for (int x = box.x; x < box.br().x; ++x) {
        if (gone_.at<std::uint8_t>(y, x) == 0) continue;
        const auto found = fillings.find(components_.at<int>(y, x));
        regions_.at<int>(y, x) = found == fillings.end() ? 0 : found->second;
      }
    }
  }

 private:
  void countBorders() {
    const cv::Rect box = cv::boundingRect(gone_);
    for (int y = box.y; y < box.br().y; ++y) {
      for (int x = box.x; x < box.br().x; ++x) {
        if (gone_.at<std::uint8_t>(y, x) == 0) continue;
        for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point next = cv::Point(x, y) + step;
          if (!cv::Rect({}, regions_.size()).contains(next)) continue;
          const int around = regions_.at<int>(next);
          if (around != region_) ++borders_[components_.at<int>(y, x)][around];
        }
      }
    }
  }

  int region_;
  cv::Mat& regions_;
  cv::Mat gone_, components_;
  std::map<int, std::map<int, int>> borders_;  // of each component: pixels beside each region
};

}  // namespace

void applyPaintedMasks(std::span<const PaintedMask> masks, cv::Mat& regions) {
  SCANTROVE_CHECK(regions.type() == CV_32SC1);
  for (const PaintedMask& painted : masks) {
    if (isMaskOf(painted.removed, regions)) {
      // One pixel more shows what lies around.
      const cv::Rect inner = cv::boundingRect(painted.removed);
      const cv::Rect box = (inner + cv::Size(2, 2) - cv::Point(1, 1)) & cv::Rect({}, regions.size());
      if (!inner.empty()) {
        cv::Mat crop = regions(box);
        PaintedOut(painted.removed(box), static_cast<int>(painted.region), crop).fill();
      }
    }
    if (isMaskOf(painted.added, regions)) addPainted(painted, regions);
  }
}

}  // namespace scantrove
