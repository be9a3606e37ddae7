#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/base/ids.h"

namespace scantrove {

/// A region that may be an object, as seen in one frame.
struct Candidate {
  RegionId region;
  cv::Rect box_px;  ///< in the working resolution
  cv::Mat mask;     ///< box_px.height x box_px.width, CV_8UC1, 255 = belongs to the region
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::Vector3f centroid_camera = Eigen::Vector3f::Zero();
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< sides of the oriented box, longest first
  int pixels = 0;                                    ///< in the working resolution
};

}  // namespace scantrove
