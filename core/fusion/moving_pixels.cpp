#include "core/fusion/moving_pixels.h"

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/fusion/known_surface.h"

namespace scantrove {
namespace {

/// Neighbouring readings of one patch differ by less than this, in metres: base + slope z.
constexpr float kStep_m = 0.02F;
constexpr float kStepSlope = 0.02F;
/// A patch moves if at least this part of it, and this many pixels, intrude.
constexpr double kIntrudingPart = 0.03;
constexpr std::size_t kIntrudingPixels = 12;

const cv::Mat& square3() {
  static const cv::Mat kSquare = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  return kSquare;
}

bool isUnknownToTheMap(std::uint8_t consistency) {
  return consistency == static_cast<std::uint8_t>(DepthConsistency::unknown) ||
         consistency == static_cast<std::uint8_t>(DepthConsistency::before);
}

}  // namespace

cv::Mat movingPixels(const cv::Mat& intruding, const cv::Mat& consistencies, const cv::Mat& z_m) {
  cv::Mat moving;
  cv::medianBlur(intruding, moving, 3);
  if (cv::countNonZero(moving) == 0) return moving;
  cv::Mat is_done = cv::Mat::zeros(z_m.size(), CV_8UC1);
  std::vector<cv::Point> patch;
  const cv::Rect image({}, z_m.size());
  // Patches grow from intruding pixels; without any there is none.
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      if (moving.at<std::uint8_t>(v, u) == 0 || is_done.at<std::uint8_t>(v, u) != 0) continue;
      patch.assign(1, {u, v});
      is_done.at<std::uint8_t>(v, u) = 1;
      std::size_t intruders = 0;
      for (std::size_t next = 0; next < patch.size(); ++next) {
        const cv::Point p = patch[next];
        const float z = z_m.at<float>(p);
        intruders += intruding.at<std::uint8_t>(p) != 0 ? 1 : 0;
        for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point q = p + step;
          if (!image.contains(q) || is_done.at<std::uint8_t>(q) != 0) continue;
          if (!isUnknownToTheMap(consistencies.at<std::uint8_t>(q)) && intruding.at<std::uint8_t>(q) == 0)
            continue;
          if (!(std::abs(z_m.at<float>(q) - z) < kStep_m + kStepSlope * z)) continue;
          is_done.at<std::uint8_t>(q) = 1;
          patch.push_back(q);
        }
      }
      if (intruders < kIntrudingPixels ||
          static_cast<double>(intruders) < kIntrudingPart * static_cast<double>(patch.size()))
        continue;
      for (const cv::Point& p : patch) moving.at<std::uint8_t>(p) = 255;
    }
  }
  cv::dilate(moving, moving, square3());
  return moving;
}

cv::Mat vacatedPixels(const cv::Mat& consistencies) {
  cv::Mat vacated = consistencies == static_cast<int>(DepthConsistency::behind);
  cv::medianBlur(vacated, vacated, 3);
  cv::erode(vacated, vacated, square3());
  return vacated;
}

}  // namespace scantrove
