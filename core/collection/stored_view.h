#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "core/base/ids.h"

namespace scantrove {

/// A view of an object that this scan gave to the catalogue, as the frame's own image showed it.
struct StoredView {
  ObjectId object;      ///< that it was stored for
  int frame_index = 0;  ///< RgbdFrame::index
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Size image_px;  ///< of the image that box, mask and depth are of
  cv::Rect box_px;
  cv::Mat mask;                ///< as Candidate::mask
  cv::Mat z_m;                 ///< CV_32FC1, of the same size: the frame's depth there, 0 = none
  Eigen::Vector3f direction;   ///< from the object to the camera, world
  float diagonal_m = 0;        ///< of the object, as this view showed it
  bool is_outdated = false;    ///< the regions of its object are others now
  bool is_of_removed = false;  ///< nor does the map still show most of what the view shows

  /// It still shows its object, as far as is known.
  [[nodiscard]] bool isValid() const { return !is_outdated && !is_of_removed; }
};

}  // namespace scantrove
