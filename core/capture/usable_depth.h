#pragma once
#include <opencv2/core/mat.hpp>

#include "core/base/check.h"
#include "core/capture/rgbd_frame.h"

namespace scantrove {

/// The depth image without readings of low confidence (0 in their place). Readings of medium confidence stay:
/// neither the map's weights nor the registration have a weight for a single reading. Without confidence the
/// result shares the pixels of RgbdFrame::depth. Any thread.
[[nodiscard]] inline cv::Mat usableDepth(const RgbdFrame& frame) {
  if (frame.confidence.empty()) return frame.depth;
  SCANTROVE_CHECK(frame.confidence.type() == CV_8UC1 && frame.confidence.size() == frame.depth.size());
  const cv::Mat is_usable = frame.confidence > kLowConfidence;
  cv::Mat depth = cv::Mat::zeros(frame.depth.size(), frame.depth.type());
  frame.depth.copyTo(depth, is_usable);
  return depth;
}

}  // namespace scantrove
