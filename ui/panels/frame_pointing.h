#pragma once
#include <QPointF>
#include <QRectF>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"

namespace scantrove {

/// Which region, and which point of its surface, lies where in the pictures of one frame. Places are
/// fractions of a picture's width and height. The colour camera may stand beside the depth camera: then its
/// picture has a map of its own.
class FramePointing {
 public:
  enum class Picture { color, other };

  void show(const ScanSnapshot& snapshot);
  void clear();

  [[nodiscard]] RegionPoint at(const QPointF& fraction, Picture picture) const;
  /// Where a point of the world is seen; none: not in the picture, or something stands before it.
  [[nodiscard]] std::optional<QPointF> placeOf(const Eigen::Vector3f& point_world, Picture picture) const;
  /// CV_32SC1 region ids by pixel of the picture at the working resolution; empty: no frame.
  [[nodiscard]] const cv::Mat& regionIds(Picture picture) const;
  /// The colour picture has a map of its own.
  [[nodiscard]] bool mapsColor() const { return !color_places_.empty(); }
  [[nodiscard]] std::vector<RegionId> regionsIn(const QRectF& fractions, Picture picture) const;

 private:
  /// Makes the colour picture's map if it has one; only when somebody points, as it takes long.
  void mapColor() const;

  cv::Mat regions_, depth_m_;  // CV_32SC1, CV_32FC1
  cv::Mat color_places_;       // as of the snapshot; empty: the pictures lie over each other
  // CV_32SC1: place in `regions_`, row by row, that a pixel of the colour picture shows; -1: none. And the
  // region that lies there. Empty: not needed so far.
  mutable cv::Mat pixel_in_color_, regions_in_color_;
  Intrinsics K_;
  Eigen::Isometry3f T_world_camera_ = Eigen::Isometry3f::Identity();
};

}  // namespace scantrove
