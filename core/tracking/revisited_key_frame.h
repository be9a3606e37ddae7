#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/tracking/color_view.h"
#include "core/tracking/key_frames.h"

namespace scantrove {

/// A place that the camera has left and sees again.
struct RevisitedKeyFrame {
  double drift_m = 0;  ///< so far beside what was seen there then the map has what is seen there now
  int landmarks = 0;   ///< by which it is known again
};

/// Whether a view, with its thumbnail (thumbnailOf), shows one of the places, the newest ones aside: those
/// are of the way that the camera has just come. It is recognised by features, wherever the map has them, so
/// that drift of any size is seen; what the surface says of less than a few centimetres is more exact.
/// `surface`: that of the map in the view. None: it shows none of them clearly, or only one that the camera
/// cannot be at, so far as that is from where it is thought to be. Any thread.
[[nodiscard]] std::optional<RevisitedKeyFrame> returnedTo(const KeyFrames& places, const cv::Mat& thumbnail,
                                                          const ColorView& view,
                                                          const SurfaceInView& surface);

}  // namespace scantrove
