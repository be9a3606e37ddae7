#include "core/evaluation/label_grid.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"

namespace scantrove {

cv::Mat1i toLabelGrid(const cv::Mat& labels) {
  SCANTROVE_CHECK(labels.type() == CV_32SC1 || labels.type() == CV_16UC1 || labels.type() == CV_8UC1);
  cv::Mat1i grid;
  labels.convertTo(grid, CV_32SC1);
  return grid;
}

cv::Mat1b boundaryPixels(const cv::Mat1i& labels) {
  cv::Mat1b boundary(labels.size(), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const bool right_differs = x + 1 < labels.cols && labels(y, x + 1) != labels(y, x);
      const bool lower_differs = y + 1 < labels.rows && labels(y + 1, x) != labels(y, x);
      if (right_differs || lower_differs) boundary(y, x) = 255;
    }
  }
  return boundary;
}

cv::Mat1f distanceToBoundary(const cv::Mat1b& boundary) {
  if (boundary.empty()) return {};
  if (cv::countNonZero(boundary) == 0) {
    const double diagonal =
        std::hypot(static_cast<double>(boundary.cols), static_cast<double>(boundary.rows));
    return cv::Mat1f(boundary.size(), static_cast<float>(diagonal));
  }
  cv::Mat1b free_pixels;
  cv::bitwise_not(boundary, free_pixels);
  cv::Mat1f distance;
  cv::distanceTransform(free_pixels, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return distance;
}

}  // namespace scantrove
