#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/capture/color_camera.h"

namespace scantrove {

/// One moment of the camera: colour, depth and what the source knows about it. Images are shared and never
/// written after the frame was made.
struct RgbdFrame {
  int index = 0;  ///< number of the frame in its source (the number in the file name where it has one)
  double timestamp_s = 0;  ///< the source's, or index / 30
  cv::Mat color;  ///< as recorded, CV_8UC3, BGR, of a size of its own; may be empty (depth-only sources)
  std::optional<ColorCamera> color_camera;  ///< of `color`, its own size; none: `color` is registered to
                                            ///< depth, that is it shows what `depth` shows, scaled
  std::filesystem::path color_file = {};    ///< that `color` was read from and shows as it is; else empty
  cv::Mat depth;  ///< h x w, CV_16UC1, 0 = no reading (all the source's invalid values are mapped to it)
  float meters_per_unit = 0.001F;  ///< z in metres = depth * meters_per_unit

  std::optional<Eigen::Isometry3d> T_world_camera;  ///< the recording's own pose, where it has one
  cv::Mat instances;  ///< ground truth, h x w, CV_16UC1, 0 = none; only from the synthetic scene
};

}  // namespace scantrove
