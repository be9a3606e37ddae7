#include "core/capture/lens_distortion.h"

#include <array>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace scantrove {

Undistorter::Undistorter(const LensDistortion& lens, const Intrinsics& K) {
  const cv::Matx33d camera(static_cast<double>(K.fx), 0, static_cast<double>(K.cx), 0,
                           static_cast<double>(K.fy), static_cast<double>(K.cy), 0, 0, 1);
  const std::array coefficients{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  cv::initUndistortRectifyMap(camera, coefficients, cv::noArray(), camera, {K.width, K.height}, CV_16SC2,
                              places_, fractions_);
}

cv::Mat Undistorter::ofColor(const cv::Mat& image) const {
  cv::Mat straight;
  cv::remap(image, straight, places_, fractions_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return straight;
}

cv::Mat Undistorter::ofDepth(const cv::Mat& depth) const {
  cv::Mat straight;
  cv::remap(depth, straight, places_, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT);
  return straight;
}

}  // namespace scantrove
