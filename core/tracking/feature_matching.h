#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "core/tracking/color_view.h"

namespace scantrove {

struct FeatureMatch {
  int feature = 0;   ///< of ColorView
  int landmark = 0;  ///< of Landmarks
  int bits = 0;      ///< of their descriptors' 256 that differ
};

/// Features, by their descriptors as ColorView has them, and landmarks that look most like each other,
/// mutually, the first of equals; no more than a quarter of their bits differ. By feature. Any thread.
[[nodiscard]] std::vector<FeatureMatch> matchAll(const cv::Mat& features, const Landmarks& landmarks);

/// The same among those that lie near each other in the image of a depth camera at `T_world_depth`, which is
/// about where it was taken from. Many times faster, and fewer that look alike are confused.
[[nodiscard]] std::vector<FeatureMatch> matchNear(const ColorView& view, const Landmarks& landmarks,
                                                  const Eigen::Isometry3d& T_world_depth);

}  // namespace scantrove
