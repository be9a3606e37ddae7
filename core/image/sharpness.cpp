#include "core/image/sharpness.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kFar_px = 8;
/// Least mean squared difference at that distance, of 255 squared: 12 grey values.
constexpr float kMinContrast = 150;
/// Known sharpness is at least this.
constexpr float kMinSharpness = 1e-3F;

/// Mean squared differences of one image direction, CV_32FC1, by square.
struct Differences {
  cv::Mat near, far;
};

/// `step`: direction, one pixel long. A square holds pairs whose first pixel it contains.
Differences differencesOf(const cv::Mat& gray, int side_px, const cv::Point& step) {
  const cv::Size squares(gray.cols / side_px, gray.rows / side_px);
  const auto meanSquare = [&](int distance) {
    const cv::Rect inside(0, 0, gray.cols - distance * step.x, gray.rows - distance * step.y);
    cv::Mat sums = cv::Mat::zeros(squares, CV_32FC1), counts = cv::Mat::zeros(squares, CV_32FC1);
    for (int y = 0; y < std::min(inside.height, squares.height * side_px); ++y) {
      const auto* row = gray.ptr<std::uint8_t>(y);
      const auto* other = gray.ptr<std::uint8_t>(y + distance * step.y) + distance * step.x;
      auto* sum = sums.ptr<float>(y / side_px);
      auto* count = counts.ptr<float>(y / side_px);
      for (int x = 0; x < std::min(inside.width, squares.width * side_px); ++x) {
        const int difference = other[x] - row[x];
        sum[x / side_px] += static_cast<float>(difference * difference);
        count[x / side_px] += 1;
      }
    }
    cv::Mat means;
    cv::divide(sums, cv::max(counts, 1), means);
    return means;
  };
  return {meanSquare(1), meanSquare(kFar_px)};
}

/// The value that a tenth of the elements is below.
float lowestTenth(const cv::Mat& values) {
  std::vector<float> all(values.begin<float>(), values.end<float>());
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 10);
  std::ranges::nth_element(all, place);
  return *place;
}

cv::Mat grayOf(const cv::Mat& color) {
  SCANTROVE_CHECK(color.type() == CV_8UC3);
  cv::Mat gray;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  return gray;
}

/// `noise`: of the squared differences, in each direction.
cv::Mat sharpnessFrom(const std::array<Differences, 2>& directions, const std::array<float, 2>& noise) {
  cv::Mat sharpness = cv::Mat::zeros(directions[0].near.size(), CV_32FC1);
  for (int y = 0; y < sharpness.rows; ++y) {
    for (int x = 0; x < sharpness.cols; ++x) {
      float& smallest = sharpness.at<float>(y, x);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const float far = directions[i].far.at<float>(y, x) - noise[i];
        if (far < kMinContrast) continue;
        const float here = std::max((directions[i].near.at<float>(y, x) - noise[i]) / far, kMinSharpness);
        smallest = smallest == 0 ? here : std::min(smallest, here);
      }
    }
  }
  return sharpness;
}

}  // namespace

cv::Mat sharpnessOfSquares(const cv::Mat& color, int side_px) {
  SCANTROVE_CHECK(side_px > 0 && color.cols >= side_px && color.rows >= side_px);
  const cv::Mat gray = grayOf(color);
  const std::array directions{differencesOf(gray, side_px, {1, 0}), differencesOf(gray, side_px, {0, 1})};
  return sharpnessFrom(directions, {lowestTenth(directions[0].near), lowestTenth(directions[1].near)});
}

float sharpnessOf(const cv::Mat& color) {
  const cv::Mat gray = grayOf(color);
  const auto meanSquare = [&gray](const cv::Point& step) -> float {
    const cv::Size size(gray.cols - step.x, gray.rows - step.y);
    if (size.width <= 0 || size.height <= 0) return 0;
    const double norm = cv::norm(gray(cv::Rect({}, size)), gray(cv::Rect(step, size)), cv::NORM_L2SQR);
    return static_cast<float>(norm / size.area());
  };
  float smallest = 0;
  for (const cv::Point& step : {cv::Point(1, 0), cv::Point(0, 1)}) {
    const float far = meanSquare(kFar_px * step);
    if (far < kMinContrast) continue;
    const float here = std::max(meanSquare(step) / far, kMinSharpness);
    smallest = smallest == 0 ? here : std::min(smallest, here);
  }
  return smallest;
}

}  // namespace scantrove
