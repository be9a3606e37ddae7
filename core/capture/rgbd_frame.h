#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace scantrove {

/// One moment of the camera: colour, depth and what the source knows about it. Images are shared and never
/// written after the frame was made. Depth and colour are of one size and registered, unless the recording is
/// not.
struct RgbdFrame {
  int index = 0;  ///< number of the frame in its source (the number in the file name where it has one)
  double timestamp_s = 0;  ///< the source's, or index / 30
  cv::Mat color;           ///< h x w, CV_8UC3, BGR; may be empty (depth-only sources)
  cv::Mat depth;  ///< h x w, CV_16UC1, 0 = no reading (all the source's invalid values are mapped to it)
  float metres_per_unit = 0.001F;  ///< z in metres = depth * metres_per_unit

  std::optional<Eigen::Isometry3d> T_world_camera;  ///< the recording's own pose, where it has one
  cv::Mat instances;  ///< ground truth, h x w, CV_16UC1, 0 = none; only from the synthetic scene
};

}  // namespace scantrove
