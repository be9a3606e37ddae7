#pragma once
#include <opencv2/core/mat.hpp>

#include "core/picture/picture_surface.h"
#include "core/picture/turntable_camera.h"

namespace scantrove {

/// A lamp at the camera: a face that looks at it has its full color, one seen from the side this part.
inline constexpr float kAmbientLight = 0.4F;

/// The color of pixels that show no surface; blue, green, red.
inline const cv::Vec3b kPictureBackground{48, 42, 40};

/// Draws the faces whose outer side the camera sees; so walls do not hide the room behind them. The nearest
/// face is shown. CV_8UC3, BGR, of the camera's size. Needs no display; uses two threads.
[[nodiscard]] cv::Mat renderSurface(const PictureSurface& surface, const PictureCamera& camera);

}  // namespace scantrove
