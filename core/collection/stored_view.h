#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"
#include "core/collection/view_choice.h"

namespace scantrove {

/// A view of an object that this scan added to the catalogue, as in the frame's own image.
struct StoredView {
  ObjectId object;      ///< the view was stored for it
  int frame_index = 0;  ///< RgbdFrame::index
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::optional<Intrinsics> intrinsics = {};  ///< RgbdFrame::intrinsics
  cv::Size image_px;                          ///< size of the image that box, mask and depth refer to
  cv::Rect box_px;
  cv::Mat mask;               ///< as Candidate::mask
  cv::Mat z_m;                ///< CV_32FC1, same size: the frame's depth there, 0 = none
  Eigen::Vector3f direction;  ///< from the object to the camera, world
  float diagonal_m = 0;       ///< of the object in this view
  ViewQuality quality;
  bool is_outdated = false;    ///< the object has other regions now
  bool is_of_removed = false;  ///< and the map no longer shows most of the view

  /// Whether it still shows its object, as far as known.
  [[nodiscard]] bool isValid() const { return !is_outdated && !is_of_removed; }
};

}  // namespace scantrove
