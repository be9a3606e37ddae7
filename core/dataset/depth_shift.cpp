#include "core/dataset/depth_shift.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kMaxShift = 20;
constexpr float kImageWidth_px = 640;
/// In narrower images the shifts of interest are hardly more than a pixel.
constexpr int kMinImageWidth_px = 320;
/// Holes beside an object, in the depth camera's pixels at that width, count as the surface behind it.
constexpr int kHole_px = 8;
/// Least step between the object and the surface behind it.
constexpr float kMinStep_m = 0.04F, kMinStepPart = 0.04F;
/// More edge pixels add time, but no certainty.
constexpr std::size_t kMinEdges = 300, kMaxEdges = 3000;
/// Stronger colour edges count as this much, so that a few cannot decide.
constexpr float kStrongEdge = 20;
/// The best shift against the mean of all, and against another one.
constexpr float kClearPeak = 1.2F, kClearlyBetter = 1.12F;

/// Depth in metres with filled holes, CV_32FC1.
cv::Mat filledDepth(const cv::Mat& depth, float meters_per_unit) {
  cv::Mat z_m, farther;
  depth.convertTo(z_m, CV_32F, meters_per_unit);
  const int rounds = std::max(1, cvRound(kHole_px * static_cast<float>(depth.cols) / kImageWidth_px));
  for (int i = 0; i < rounds; ++i) {
    cv::dilate(z_m, farther, cv::Mat());
    farther.copyTo(z_m, z_m <= 0);
  }
  return z_m;
}

/// Pixels of objects beside a farther surface, evenly selected, seen from the colour camera.
std::vector<cv::Point2f> edgesInColor(const KeyFrameInfo& frame, const cv::Mat& z_m) {
  std::vector<cv::Point> edges;
  for (int y = 1; y + 1 < z_m.rows; ++y) {
    for (int x = 1; x + 1 < z_m.cols; ++x) {
      const float z = z_m.at<float>(y, x);
      if (!(z > 0)) continue;
      const float behind = std::max({z_m.at<float>(y, x - 1), z_m.at<float>(y, x + 1),
                                     z_m.at<float>(y - 1, x), z_m.at<float>(y + 1, x)});
      if (behind > z + std::max(kMinStep_m, kMinStepPart * z)) edges.emplace_back(x, y);
    }
  }
  const Eigen::Isometry3f T = frame.T_color_depth.cast<float>();
  const std::size_t step = edges.size() / kMaxEdges + 1;
  std::vector<cv::Point2f> projected;
  for (std::size_t i = 0; i < edges.size(); i += step) {
    const cv::Point& edge = edges[i];
    const Eigen::Vector3f p = T * frame.K_depth.backProject(static_cast<float>(edge.x),
                                                            static_cast<float>(edge.y), z_m.at<float>(edge));
    if (!(p.z() > 0)) continue;
    const Intrinsics& K = frame.K_color;
    projected.emplace_back(K.fx * p.x() / p.z() + K.cx, K.fy * p.y() / p.z() + K.cy);
  }
  return projected;
}

/// Strength of the colour edges, CV_32FC1, at most kStrongEdge.
cv::Mat edgeStrength(const cv::Mat& color) {
  cv::Mat smooth, across, down;
  cv::GaussianBlur(color, smooth, {}, 1);
  cv::Sobel(smooth, across, CV_32F, 1, 0);
  cv::Sobel(smooth, down, CV_32F, 0, 1);
  constexpr float kSumOfSobel = 8;
  cv::Mat strength(color.size(), CV_32FC1);
  for (int y = 0; y < color.rows; ++y) {
    const auto* a = across.ptr<cv::Vec3f>(y);
    const auto* d = down.ptr<cv::Vec3f>(y);
    auto* out = strength.ptr<float>(y);
    for (int x = 0; x < color.cols; ++x) {
      float largest = 0;
      for (int i = 0; i < 3; ++i) largest = std::max(largest, std::hypot(a[x][i], d[x][i]));
      out[x] = std::min(largest / kSumOfSobel, kStrongEdge);
    }
  }
  return strength;
}

}  // namespace

DepthShift::DepthShift(const KeyFrameInfo& frame, const cv::Mat& depth, const cv::Mat& color) {
  SCANTROVE_CHECK(depth.type() == CV_16UC1 && color.type() == CV_8UC3);
  if (color.cols < kMinImageWidth_px) return;
  const int stride_px = std::max(1, cvRound(static_cast<float>(color.cols) / kImageWidth_px));
  stride_ = static_cast<float>(stride_px) * kImageWidth_px / static_cast<float>(color.cols);
  const cv::Mat strength = edgeStrength(color);
  constexpr int kShifts = 2 * kMaxShift + 1;
  cv::Mat sums = cv::Mat::zeros(kShifts, kShifts, CV_32FC1);
  const int margin = kMaxShift * stride_px;
  const cv::Rect inside(margin, margin, color.cols - 2 * margin, color.rows - 2 * margin);
  std::size_t count = 0;
  for (const cv::Point2f& edge : edgesInColor(frame, filledDepth(depth, frame.meters_per_unit))) {
    const cv::Point pixel(cvRound(edge.x), cvRound(edge.y));
    if (!inside.contains(pixel)) continue;
    ++count;
    for (int j = 0; j < kShifts; ++j) {
      const auto* from = strength.ptr<float>(pixel.y + (j - kMaxShift) * stride_px) + pixel.x - margin;
      auto* sum = sums.ptr<float>(j);
      for (int i = 0; i < kShifts; ++i) sum[i] += from[i * stride_px];
    }
  }
  const auto least = static_cast<float>(kMinEdges) * static_cast<float>(depth.cols) / kImageWidth_px;
  if (static_cast<float>(count) >= std::min(least, static_cast<float>(kMinEdges)))
    fits_ = sums / static_cast<double>(std::max<std::size_t>(count, 1));
}

std::optional<cv::Point2f> DepthShift::best() const {
  if (fits_.empty()) return std::nullopt;
  double largest = 0;
  cv::Point place;
  cv::minMaxLoc(fits_, nullptr, &largest, nullptr, &place);
  const cv::Rect within(1, 1, fits_.cols - 2,
                        fits_.rows - 2);  // beyond the largest shift it may rise further
  if (!within.contains(place) || largest < kClearPeak * cv::mean(fits_)[0]) return std::nullopt;
  return cv::Point2f(place - cv::Point(kMaxShift, kMaxShift)) * stride_;
}

bool DepthShift::isBetterThan(const cv::Point2f& other) const {
  if (fits_.empty()) return false;
  double largest = 0, largest_there = 0;
  cv::minMaxLoc(fits_, nullptr, &largest);
  const cv::Point place(kMaxShift + cvRound(other.x / stride_), kMaxShift + cvRound(other.y / stride_));
  const cv::Rect around = cv::Rect(place - cv::Point(1, 1), cv::Size(3, 3)) & cv::Rect({}, fits_.size());
  if (!around.empty()) cv::minMaxLoc(fits_(around), nullptr, &largest_there);
  return largest >= kClearlyBetter * largest_there;
}

}  // namespace scantrove
