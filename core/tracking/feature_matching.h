#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "core/tracking/color_view.h"

namespace scantrove {

struct FeatureMatch {
  int feature = 0;   ///< of ColorView
  int landmark = 0;  ///< of Landmarks
  int bits = 0;      ///< different ones of their descriptors' 256
};

/// Mutual nearest neighbours of features (ColorView::descriptors) and landmarks, in the order of features;
/// the first of equals. At most a quarter of their bits differ. Any thread.
[[nodiscard]] std::vector<FeatureMatch> matchAll(const cv::Mat& features, const Landmarks& landmarks);

/// The same, but only among pairs that are near each other in the image when the depth camera is at
/// `T_world_depth`, an approximate pose. Many times faster, and confuses fewer similar features.
[[nodiscard]] std::vector<FeatureMatch> matchNear(const ColorView& view, const Landmarks& landmarks,
                                                  const Eigen::Isometry3d& T_world_depth);

}  // namespace scantrove
