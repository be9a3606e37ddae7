#include "core/capture/adapted_frame.h"

#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// What `wanted` sees of an image that `own` took.
cv::Mat seenBy(const Intrinsics& wanted, const cv::Mat& image, const Intrinsics& own, int interpolation) {
  if (image.empty()) return image;
  cv::Mat columns(wanted.height, wanted.width, CV_32FC1), rows(wanted.height, wanted.width, CV_32FC1);
  for (int v = 0; v < wanted.height; ++v) {
    for (int u = 0; u < wanted.width; ++u) {
      columns.at<float>(v, u) = own.fx * (static_cast<float>(u) - wanted.cx) / wanted.fx + own.cx;
      rows.at<float>(v, u) = own.fy * (static_cast<float>(v) - wanted.cy) / wanted.fy + own.cy;
    }
  }
  cv::Mat seen;
  cv::remap(image, seen, columns, rows, interpolation, cv::BORDER_CONSTANT);
  return seen;
}

}  // namespace

void adaptToCamera(RgbdFrame& frame, const Intrinsics& own, const Intrinsics& wanted, cv::Size color_size) {
  if (color_size.empty()) color_size = frame.color.size();
  frame.depth = seenBy(wanted, frame.depth, own, cv::INTER_NEAREST);
  frame.confidence = seenBy(wanted, frame.confidence, own, cv::INTER_NEAREST);
  frame.instances = seenBy(wanted, frame.instances, own, cv::INTER_NEAREST);
  frame.intrinsics.reset();
  if (frame.color.empty()) return;
  frame.color_file.clear();
  if (!frame.color_camera) {
    frame.color = seenBy(wanted.resizedTo(color_size.width, color_size.height), frame.color,
                         own.resizedTo(frame.color.cols, frame.color.rows), cv::INTER_LINEAR);
  } else if (frame.color.size() != color_size) {
    cv::Mat resized;
    cv::resize(frame.color, resized, color_size, 0, 0, cv::INTER_AREA);
    frame.color_camera->K = frame.color_camera->K.resizedTo(color_size.width, color_size.height);
    frame.color = resized;
  }
}

}  // namespace scantrove
