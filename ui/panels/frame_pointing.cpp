#include "ui/panels/frame_pointing.h"

#include <algorithm>
#include <cmath>

#include "ui/panels/region_picture.h"

namespace scantrove {
namespace {

/// A point this far behind the surface is hidden; as a fraction of the distance.
constexpr float kHidden = 0.03F;

/// Pixel at a fraction of the image size.
cv::Point pixelAt(const QPointF& fraction, const cv::Mat& image) {
  return {std::clamp(static_cast<int>(fraction.x() * image.cols), 0, image.cols - 1),
          std::clamp(static_cast<int>(fraction.y() * image.rows), 0, image.rows - 1)};
}

}  // namespace

void FramePointing::show(const ScanSnapshot& snapshot) {
  regions_ = snapshot.regions;
  depth_m_ = snapshot.depth_fused_m;
  K_ = snapshot.K;
  T_world_camera_ = snapshot.pose.T_world_camera.cast<float>();
  pixel_in_color_.release();
  color_places_.release();
  regions_in_color_.release();
  if (!regions_.empty() && snapshot.color_places.size() == regions_.size())
    color_places_ = snapshot.color_places;
}

void FramePointing::clear() {
  for (cv::Mat* image : {&regions_, &depth_m_, &color_places_, &pixel_in_color_, &regions_in_color_})
    image->release();
}

void FramePointing::mapColor() const {
  if (!mapsColor() || !pixel_in_color_.empty()) return;
  pixel_in_color_ = cv::Mat(regions_.size(), CV_32SC1, cv::Scalar(-1));
  cv::Mat nearest(regions_.size(), CV_32FC1, cv::Scalar(1e9));
  for (int y = 0; y < regions_.rows; ++y) {
    for (int x = 0; x < regions_.cols; ++x) {
      const float z = depth_m_.empty() ? 0 : depth_m_.at<float>(y, x);
      if (!(z > 0)) continue;
      const auto& place = color_places_.at<cv::Vec2f>(y, x);
      const int column = static_cast<int>(std::floor(place[0] * static_cast<float>(regions_.cols)));
      const int row = static_cast<int>(std::floor(place[1] * static_cast<float>(regions_.rows)));
      // Drawn three pixels wide, so that magnified surfaces have no gaps.
      for (int v = std::max(0, row - 1); v <= std::min(regions_.rows - 1, row + 1); ++v) {
        for (int u = std::max(0, column - 1); u <= std::min(regions_.cols - 1, column + 1); ++u) {
          const float behind = (u == column && v == row) ? 0.0F : 0.02F * z;
          if (z + behind >= nearest.at<float>(v, u)) continue;
          nearest.at<float>(v, u) = z + behind;
          pixel_in_color_.at<int>(v, u) = y * regions_.cols + x;
        }
      }
    }
  }
  regions_in_color_ = cv::Mat(regions_.size(), CV_32SC1, cv::Scalar(0));
  for (int y = 0; y < regions_.rows; ++y) {
    for (int x = 0; x < regions_.cols; ++x) {
      const int pixel = pixel_in_color_.at<int>(y, x);
      if (pixel >= 0)
        regions_in_color_.at<int>(y, x) = regions_.at<int>(pixel / regions_.cols, pixel % regions_.cols);
    }
  }
}

RegionPoint FramePointing::at(const QPointF& fraction, Picture picture) const {
  RegionPoint point;
  if (regions_.empty()) return point;
  cv::Point pixel = pixelAt(fraction, regions_);
  if (picture == Picture::color && mapsColor()) {
    mapColor();
    const int of_depth = pixel_in_color_.at<int>(pixel);
    if (of_depth < 0) return point;
    pixel = {of_depth % regions_.cols, of_depth / regions_.cols};
  }
  point.region = RegionId{static_cast<std::uint32_t>(std::max(0, regions_.at<int>(pixel)))};
  if (depth_m_.size() != regions_.size()) return point;
  const float z = depth_m_.at<float>(pixel);
  if (z > 0) {
    point.point_world =
        T_world_camera_ * K_.backProject(static_cast<float>(pixel.x), static_cast<float>(pixel.y), z);
  }
  return point;
}

std::optional<QPointF> FramePointing::positionOf(const Eigen::Vector3f& point_world, Picture picture) const {
  if (depth_m_.empty()) return std::nullopt;
  const Eigen::Vector3f point = T_world_camera_.inverse() * point_world;
  if (!(point.z() > 0)) return std::nullopt;
  const cv::Point pixel(static_cast<int>(std::lround(K_.fx * point.x() / point.z() + K_.cx)),
                        static_cast<int>(std::lround(K_.fy * point.y() / point.z() + K_.cy)));
  if (!cv::Rect({}, depth_m_.size()).contains(pixel)) return std::nullopt;
  const float z = depth_m_.at<float>(pixel);
  if (!(z > 0) || point.z() - z > kHidden * z) return std::nullopt;
  if (picture == Picture::color && mapsColor()) {
    const auto& place = color_places_.at<cv::Vec2f>(pixel);
    return QPointF(place[0], place[1]);
  }
  return QPointF((pixel.x + 0.5) / depth_m_.cols, (pixel.y + 0.5) / depth_m_.rows);
}

const cv::Mat& FramePointing::regionIds(Picture picture) const {
  if (picture != Picture::color || !mapsColor()) return regions_;
  mapColor();
  return regions_in_color_;
}

std::vector<RegionId> FramePointing::regionsIn(const QRectF& fractions, Picture picture) const {
  const cv::Mat& ids = regionIds(picture);
  if (ids.empty()) return {};
  const cv::Point first = pixelAt(fractions.topLeft(), ids);
  const cv::Point last = pixelAt(fractions.bottomRight(), ids);
  return scantrove::regionsIn(ids, cv::Rect(first, last + cv::Point(1, 1)));
}

}  // namespace scantrove
