#include "core/capture/lens_distortion.h"

#include <array>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace scantrove {

namespace {

/// The point that the formula takes `point` to, in units of the focal length.
cv::Point2d afterLens(const LensDistortion& lens, const cv::Point2d& point) {
  const auto [x, y] = std::pair(point.x, point.y);
  const double r2 = x * x + y * y;
  const double radial = (1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))) /
                        (1 + r2 * (lens.k4 + r2 * (lens.k5 + r2 * lens.k6)));
  return {x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x),
          y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y};
}

/// The point that the formula takes to `target`, by fixed-point iteration, which converges for the few
/// percent that lenses distort by.
cv::Point2d beforeLens(const LensDistortion& lens, const cv::Point2d& target) {
  constexpr int kIterations = 10;
  cv::Point2d point = target;
  for (int i = 0; i < kIterations; ++i) point += target - afterLens(lens, point);
  return point;
}

/// Source column and row (two channels) of each pixel, for a lens with LensDistortion::is_inverse.
cv::Mat inverseLensMap(const LensDistortion& lens, const Intrinsics& K) {
  const double fx = static_cast<double>(K.fx), fy = static_cast<double>(K.fy);
  const double cx = static_cast<double>(K.cx), cy = static_cast<double>(K.cy);
  cv::Mat2f map(K.height, K.width);
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const cv::Point2d bent = beforeLens(lens, {(u - cx) / fx, (v - cy) / fy});
      map(v, u) = {static_cast<float>(fx * bent.x + cx), static_cast<float>(fy * bent.y + cy)};
    }
  }
  return map;
}

}  // namespace

Undistorter::Undistorter(const LensDistortion& lens, const Intrinsics& K) {
  if (lens.is_inverse) {
    cv::convertMaps(inverseLensMap(lens, K), cv::noArray(), places_, fractions_, CV_16SC2);
    return;
  }
  const cv::Matx33d camera(static_cast<double>(K.fx), 0, static_cast<double>(K.cx), 0,
                           static_cast<double>(K.fy), static_cast<double>(K.cy), 0, 0, 1);
  const std::array coefficients{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6};
  cv::initUndistortRectifyMap(camera, coefficients, cv::noArray(), camera, {K.width, K.height}, CV_16SC2,
                              places_, fractions_);
  // The integer parts of places_ are rounded down, half a pixel off on average.
  cv::Mat x, y;
  cv::initUndistortRectifyMap(camera, coefficients, cv::noArray(), camera, {K.width, K.height}, CV_32FC1, x,
                              y);
  cv::convertMaps(x, y, nearest_, cv::noArray(), CV_16SC2, true);
}

cv::Mat Undistorter::ofColor(const cv::Mat& image) const {
  cv::Mat straight;
  cv::remap(image, straight, places_, fractions_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return straight;
}

cv::Mat Undistorter::ofDepth(const cv::Mat& depth) const {
  cv::Mat straight;
  cv::remap(depth, straight, nearest_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return straight;
}

}  // namespace scantrove
