#include "core/tracking/color_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/fusion/view_depths.h"

namespace scantrove {
namespace {

constexpr int kWidest_px = 640;     // wider images are reduced before feature extraction
constexpr int kMaxFeatures = 1000;  // the strongest; bounds the cost of matching
constexpr int kMinContrast = 8;     // grey levels, of a corner
// Defaults of ORB's authors and of OpenCV.
constexpr float kScaleFactor = 1.2F;
constexpr int kScales = 8, kPatch_px = 31, kPointsPerBit = 2;
// Cell size for looking up the surface; as fine as the working resolution.
constexpr int kCell_px = 2;
// A feature is on an outline, and its surface unknown, if its surroundings differ in depth by more than this
// part.
constexpr float kOutlineStep = 0.04F;

Eigen::Vector3f toPoint(const cl_float4& v) { return {v.s[0], v.s[1], v.s[2]}; }

}  // namespace

GrayView grayViewOf(const RgbdFrame& frame, const Intrinsics& K_depth) {
  GrayView view;
  if (frame.color.empty()) return view;
  cv::cvtColor(frame.color, view.image, cv::COLOR_BGR2GRAY);
  if (view.image.cols > kWidest_px) {
    const double scale = static_cast<double>(kWidest_px) / view.image.cols;
    cv::resize(view.image, view.image, {}, scale, scale, cv::INTER_AREA);
  }
  blankUnscanned(view.image, frame.scanned);
  view.K = (frame.color_camera ? frame.color_camera->K : frame.intrinsics.value_or(K_depth))
               .resizedTo(view.image.cols, view.image.rows);
  if (frame.color_camera) view.T_color_depth = frame.color_camera->T_color_depth;
  return view;
}

void blankUnscanned(cv::Mat& gray, const cv::Mat& scanned) {
  if (scanned.empty()) return;
  cv::Mat is_scanned;
  cv::resize(scanned, is_scanned, gray.size(), 0, 0, cv::INTER_NEAREST);
  gray.setTo(cv::mean(gray, is_scanned), is_scanned == 0);
}

SurfaceInView::SurfaceInView(const Intrinsics& K, const Eigen::Isometry3d& T_world_color,
                             std::span<const cl_float4> vertices_world)
    : K_(K),
      T_world_color_(T_world_color.cast<float>()),
      depths_((K.height + kCell_px - 1) / kCell_px, (K.width + kCell_px - 1) / kCell_px, CV_32FC1,
              cv::Scalar(0)) {
  const Eigen::Isometry3f T_color_world = T_world_color.inverse().cast<float>();
  for (const cl_float4& vertex : vertices_world) {
    if (!(vertex.s[3] > 0)) continue;
    const Eigen::Vector3f p = T_color_world * toPoint(vertex);
    if (!(p.z() > kNearestView_m)) continue;
    const float u = K.fx * p.x() / p.z() + K.cx + 0.5F;
    const float v = K.fy * p.y() / p.z() + K.cy + 0.5F;
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(K.width) && v < static_cast<float>(K.height))) continue;
    float& depth = depths_.at<float>(static_cast<int>(v) / kCell_px, static_cast<int>(u) / kCell_px);
    if (depth == 0 || p.z() < depth) depth = p.z();
  }
}

float SurfaceInView::depthAt(const cv::Point2f& pixel) const {
  const int column = static_cast<int>(std::lround(pixel.x)) / kCell_px;
  const int row = static_cast<int>(std::lround(pixel.y)) / kCell_px;
  if (row < 0 || column < 0 || row >= depths_.rows || column >= depths_.cols) return 0;
  float nearest = std::numeric_limits<float>::max();
  float farthest = 0;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, depths_.rows - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, depths_.cols - 1); ++c) {
      const float depth = depths_.at<float>(r, c);
      if (depth == 0) continue;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  if (farthest == 0 || farthest - nearest > kOutlineStep * nearest) return 0;
  const float own = depths_.at<float>(row, column);
  return own > 0 ? own : (nearest + farthest) / 2;
}

std::optional<Eigen::Vector3f> SurfaceInView::at(const cv::Point2f& pixel) const {
  const float depth = depthAt(pixel);
  if (!(depth > 0)) return std::nullopt;
  return T_world_color_ * K_.backProject(pixel.x, pixel.y, depth);
}

ColorView FeatureFinder::find(const GrayView& gray) {
  ColorView view;
  if (gray.image.empty()) return view;
  view.K = gray.K;
  view.T_color_depth = gray.T_color_depth;
  if (!orb_)
    orb_ = cv::ORB::create(kMaxFeatures, kScaleFactor, kScales, kPatch_px, 0, kPointsPerBit,
                           cv::ORB::HARRIS_SCORE, kPatch_px, kMinContrast);
  std::vector<cv::KeyPoint> points;
  orb_->detectAndCompute(gray.image, cv::noArray(), points, view.descriptors);
  cv::KeyPoint::convert(points, view.pixels);
  return view;
}

Landmarks landmarksOf(const ColorView& view, const Eigen::Isometry3d& T_world_depth,
                      std::span<const cl_float4> vertices_world) {
  Landmarks landmarks;
  if (view.pixels.empty()) return landmarks;
  const SurfaceInView surface(view.K, T_world_depth * view.T_color_depth.inverse(), vertices_world);
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    const auto p = surface.at(view.pixels[i]);
    if (!p) continue;
    landmarks.points_world.emplace_back(p->x(), p->y(), p->z());
    landmarks.descriptors.push_back(view.descriptors.row(static_cast<int>(i)));
  }
  return landmarks;
}

}  // namespace scantrove
