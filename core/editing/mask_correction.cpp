#include "core/editing/mask_correction.h"

#include <opencv2/core.hpp>

#include "core/base/check.h"

namespace scantrove {

MaskCorrection correctionOf(const cv::Mat& added, const cv::Mat& removed) {
  SCANTROVE_CHECK(added.type() == CV_8UC1 && removed.type() == CV_8UC1 && added.size() == removed.size());
  const cv::Mat rest = (removed != 0) & (added == 0);
  return {.added = PaintedPixels::of(added), .removed = PaintedPixels::of(rest)};
}

}  // namespace scantrove
