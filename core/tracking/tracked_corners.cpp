#include "core/tracking/tracked_corners.h"

#include <algorithm>
#include <functional>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

namespace scantrove {
namespace {

constexpr std::size_t kMaxCorners = 300;     // bounds the cost of a frame
constexpr std::size_t kEnoughCorners = 150;  // below this the slower search for faint corners runs
constexpr int kMinStep = 10;                 // threshold of FAST, in grey levels
constexpr double kMinQuality = 0.01;         // of the best corner's
constexpr int kApart_px = 12;                // least distance between corners: half a window
// Optical flow: window and levels are OpenCV's defaults, which allow motions of some dozens of pixels. Steps
// below 1/50 pixel are finer than the depths.
const cv::Size kWindow(21, 21);
constexpr int kLevels = 3, kMaxFlowSteps = 20;
constexpr double kFlowConverged_px = 0.02;
constexpr float kWayBack_px = 0.5F;  // largest error when a corner is followed forth and back

/// The strongest points first, without those near a stronger one.
std::vector<cv::Point2f> spreadOut(std::vector<cv::KeyPoint> points, const cv::Size& size) {
  std::ranges::stable_sort(points, std::ranges::greater(), &cv::KeyPoint::response);
  const cv::Rect cells(0, 0, size.width / kApart_px + 1, size.height / kApart_px + 1);
  cv::Mat taken(cells.size(), CV_32FC2,
                cv::Scalar::all(-kApart_px));  // the point of each cell, or one outside
  std::vector<cv::Point2f> corners;
  for (const cv::KeyPoint& point : points) {
    if (corners.size() == kMaxCorners) break;
    const int column = static_cast<int>(point.pt.x) / kApart_px;
    const int row = static_cast<int>(point.pt.y) / kApart_px;
    const cv::Mat around = taken(cv::Rect(column - 1, row - 1, 3, 3) & cells);
    const bool is_near =
        std::any_of(around.begin<cv::Point2f>(), around.end<cv::Point2f>(),
                    [&](const cv::Point2f& other) { return cv::norm(other - point.pt) < kApart_px; });
    if (is_near) continue;
    taken.at<cv::Point2f>(row, column) = point.pt;
    corners.push_back(point.pt);
  }
  return corners;
}

/// FAST takes a quarter of the time and suffices with enough contrast. Otherwise eigenvalues of the gradients
/// find the faintest corners.
std::vector<cv::Point2f> cornersOf(const cv::Mat& image) {
  std::vector<cv::KeyPoint> points;
  cv::FAST(image, points, kMinStep);
  std::vector<cv::Point2f> corners = spreadOut(std::move(points), image.size());
  if (corners.size() < kEnoughCorners)
    cv::goodFeaturesToTrack(image, corners, kMaxCorners, kMinQuality, kApart_px);
  return corners;
}

std::vector<cv::Mat> pyramidOf(const cv::Mat& image) {
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, kWindow, kLevels);
  return pyramid;
}

}  // namespace

SeenLandmarks trackCorners(const GrayView& last, const SurfaceInView& surface, const GrayView& now,
                           const Eigen::Isometry3d& T_world_color) {
  SeenLandmarks seen;
  seen.K = now.K;
  seen.T_color_depth = now.T_color_depth;
  if (last.image.empty() || last.image.size() != now.image.size()) return seen;
  const Eigen::Isometry3f T_color_world = T_world_color.inverse().cast<float>();
  std::vector<cv::Point2f> from, to;
  std::vector<Eigen::Vector3d> points;
  for (const cv::Point2f& corner : cornersOf(last.image)) {
    const auto point = surface.at(corner);
    if (!point) continue;
    const Eigen::Vector3f p = T_color_world * *point;
    if (!(p.z() > kNearestLandmark_m)) continue;
    from.push_back(corner);
    to.emplace_back(now.K.fx * p.x() / p.z() + now.K.cx, now.K.fy * p.y() / p.z() + now.K.cy);
    points.push_back(point->cast<double>());
  }
  if (from.empty()) return seen;
  std::vector<cv::Point2f> back = from;
  std::vector<std::uint8_t> is_found, is_back;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kMaxFlowSteps,
                               kFlowConverged_px);
  const std::vector<cv::Mat> before = pyramidOf(last.image), after = pyramidOf(now.image);
  cv::calcOpticalFlowPyrLK(before, after, from, to, is_found, cv::noArray(), kWindow, kLevels, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  cv::calcOpticalFlowPyrLK(after, before, to, back, is_back, cv::noArray(), kWindow, kLevels, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (is_found[i] == 0 || is_back[i] == 0 || cv::norm(back[i] - from[i]) > kWayBack_px) continue;
    seen.points_world.push_back(points[i]);
    seen.pixels.push_back(Eigen::Vector2f(to[i].x, to[i].y).cast<double>());
  }
  return seen;
}

}  // namespace scantrove
