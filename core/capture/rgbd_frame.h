#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/capture/color_camera.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

// RgbdFrame::confidence. Readings of low confidence are neither fused nor tracked.
inline constexpr unsigned char kLowConfidence = 0, kMediumConfidence = 1, kHighConfidence = 2;

/// Colour, depth and metadata of one moment. Images are shared and immutable.
struct RgbdFrame {
  int index = 0;  ///< number of the frame in its source (the number in the file name where it has one)
  double timestamp_s = 0;  ///< the source's, or index / 30
  cv::Mat color;           ///< as recorded, CV_8UC3, BGR, own size; empty: this frame has none
  std::optional<ColorCamera>
      color_camera;                       ///< separate camera of `color`; none: registered to `depth`, scaled
  std::filesystem::path color_file = {};  ///< file whose pixels `color` holds unchanged; else empty
  cv::Mat depth;  ///< h x w, CV_16UC1, 0 = no reading (all invalid values of the source become 0)
  float meters_per_unit = 0.001F;  ///< z in metres = depth * meters_per_unit
  /// Confidence of each reading, h x w, CV_8UC1: kLowConfidence, kMediumConfidence or kHighConfidence. Empty:
  /// the source tells none, all are high.
  cv::Mat confidence = {};
  /// The depth camera of this frame, where it changes during the recording (autofocus); of the depth image's
  /// size. None: SourceInfo::intrinsics.
  std::optional<Intrinsics> intrinsics = {};

  /// The part of the colour image that is scanned, CV_8UC1, of any size: scaled like the image; 0: tracking
  /// sees nothing there. Empty: all of it.
  cv::Mat scanned = {};

  /// The recording's own pose, where it has one; SourceInfo::pose_origin.
  std::optional<Eigen::Isometry3d> T_world_camera;
  cv::Mat instances;  ///< ground truth, h x w, CV_16UC1, 0 = none; only from the synthetic scene
};

}  // namespace scantrove
