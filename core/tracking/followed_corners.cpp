#include "core/tracking/followed_corners.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace scantrove {
namespace {

constexpr int kMostCorners = 300;
constexpr double kLeastQuality = 0.01;  // of the best corner's
constexpr double kApart_px = 12;
const cv::Size kWindow(21, 21);
constexpr int kLevels = 3;
constexpr float kWayBack_px = 0.5F;  // a corner that does not come back to where it was is another one
// Corners of wider images are looked for in an image of half the size: the flow follows the surroundings of
// any pixel, however exactly that sits on the corner.
constexpr int kFine_px = 400;

std::vector<cv::Point2f> cornersOf(const cv::Mat& image) {
  std::vector<cv::Point2f> corners;
  if (image.cols <= kFine_px) {
    cv::goodFeaturesToTrack(image, corners, kMostCorners, kLeastQuality, kApart_px);
    return corners;
  }
  cv::Mat half;
  cv::resize(image, half, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::goodFeaturesToTrack(half, corners, kMostCorners, kLeastQuality, kApart_px / 2);
  for (cv::Point2f& corner : corners) corner = 2 * corner + cv::Point2f(0.5F, 0.5F);  // from centre to centre
  return corners;
}

std::vector<cv::Mat> pyramidOf(const cv::Mat& image) {
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, kWindow, kLevels);
  return pyramid;
}

}  // namespace

SeenLandmarks followCorners(const GrayView& last, const SurfaceInView& surface, const GrayView& now,
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
    if (!(p.z() > 0.1F)) continue;
    from.push_back(corner);
    to.emplace_back(now.K.fx * p.x() / p.z() + now.K.cx, now.K.fy * p.y() / p.z() + now.K.cy);
    points.push_back(point->cast<double>());
  }
  if (from.empty()) return seen;
  std::vector<cv::Point2f> back = from;
  std::vector<std::uint8_t> is_found, is_back;
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.02);
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
