#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/tracking/color_view.h"
#include "core/tracking/key_frames.h"

namespace scantrove {

/// A loop closure: a key frame that the camera left and sees again.
struct RevisitedKeyFrame {
  double drift_m = 0;  ///< distance between the map's surface now and what was seen there then
  int landmarks = 0;   ///< matched
};

/// Detects a loop closure: whether a view, with its thumbnail (thumbnailOf), shows one of the key frames.
/// Skips the newest ones, which the camera has just passed. Features find the key frame wherever the map has
/// it, so that drift of any size is measured; below a few centimetres the surface is more exact. `surface`:
/// the map's in the view. None: no key frame is matched clearly, or only one implausibly far away. Any
/// thread.
[[nodiscard]] std::optional<RevisitedKeyFrame> returnedTo(const KeyFrames& key_frames,
                                                          const cv::Mat& thumbnail, const ColorView& view,
                                                          const SurfaceInView& surface);

}  // namespace scantrove
