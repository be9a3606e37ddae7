#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

class OpenSession;
struct SavedKeyFrame;

/// The image of a key frame with its regions, as data sets have it: at the resolution of its colour image,
/// without one at that of its depth image. The images are shared and not modified any more.
struct KeyFrameLabels {
  int index = -1;     ///< in ScanSnapshot::key_frames
  int key_frame = 0;  ///< SavedFrame::number
  int image = 0;      ///< number of the frame for data sets and users
  cv::Mat color;      ///< CV_8UC3 BGR; empty without colour
  cv::Mat regions;    ///< CV_32SC1, all regions, 0 = none
  cv::Mat depth_m;    ///< CV_32FC1, as measured, 0 = no reading
  cv::Mat fused_m;    ///< CV_32FC1, of the map, 0 = none
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// Reads and labels it, with what a person painted. Error: its images cannot be read; the device failed.
[[nodiscard]] Result<KeyFrameLabels> labelKeyFrame(OpenSession& session, const SavedKeyFrame& key_frame);

}  // namespace scantrove
