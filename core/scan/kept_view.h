#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/base/ids.h"
#include "core/discovery/candidate.h"

namespace scantrove {

/// A view of an object as a scan cut it out of a frame.
struct KeptView {
  ObjectId object;  ///< that it was stored for
  int frame_index = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Size image_px;  ///< of the image that the rest of this is of
  cv::Rect box_px;
  cv::Mat mask;                       ///< as Candidate::mask
  cv::Mat z_m;                        ///< CV_32FC1, of the same size: the frame's readings there, 0 = none
  Eigen::Vector3f direction;          ///< from the object to the camera, world
  float diagonal_m = 0;               ///< of the object, as this view showed it
  bool is_outdated = false;           ///< its object's regions are others now
  bool shows_removed_object = false;  ///< nor is most of what it shows there any more
};

}  // namespace scantrove
