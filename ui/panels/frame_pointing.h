#pragma once
#include <QPointF>
#include <QRectF>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"

namespace scantrove {

/// Finds the region and surface point at a position in the pictures of one frame, and the reverse. Positions
/// are fractions of a picture's width and height. If the colour camera has another viewpoint than the depth
/// camera, the colour picture has its own pixel map.
class FramePointing {
 public:
  enum class Picture { color, other };

  void show(const ScanSnapshot& snapshot);
  void clear();

  [[nodiscard]] RegionPoint at(const QPointF& fraction, Picture picture) const;
  /// Position of a world point in the picture; none: outside of it or occluded.
  [[nodiscard]] std::optional<QPointF> positionOf(const Eigen::Vector3f& point_world, Picture picture) const;
  /// CV_32SC1 region ids by pixel of the picture at the working resolution; empty: no frame.
  [[nodiscard]] const cv::Mat& regionIds(Picture picture) const;
  /// Whether the colour picture has its own pixel map.
  [[nodiscard]] bool mapsColor() const { return !color_places_.empty(); }
  [[nodiscard]] std::vector<RegionId> regionsIn(const QRectF& fractions, Picture picture) const;

 private:
  /// Builds the pixel map of the colour picture. Slow, so it is done when it is first needed.
  void mapColor() const;

  cv::Mat regions_, depth_m_;  // CV_32SC1, CV_32FC1
  cv::Mat color_places_;       // as in the snapshot; empty: the pictures are aligned
  // CV_32SC1 by pixel of the colour picture: index into `regions_`, row by row, -1: none; and the region at
  // that index. Empty: not built yet.
  mutable cv::Mat pixel_in_color_, regions_in_color_;
  Intrinsics K_;
  Eigen::Isometry3f T_world_camera_ = Eigen::Isometry3f::Identity();
};

}  // namespace scantrove
