#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/color_camera.h"

namespace scantrove {

/// The colour camera of a Kinect v1 as it leaves the factory: 528 pixels for 640x480, its lens 25 mm from
/// that of depth. A single one may be off by a few pixels.
[[nodiscard]] ColorCamera kinectColorCamera();

/// Reads "registered", "kinect", or numbers: fx,fy,cx,cy,x or with y,z or with y,z,rx,ry,rz. Pixels of the
/// colour images; then T_color_depth: metres, and degrees about the axis (rx, ry, rz). Error: names
/// `text` and says what can be given.
[[nodiscard]] Result<ColorRegistration> parseColorRegistration(const std::string& text);

/// The camera of colour images of `size` over the depth images of `depth_K`; none: registered to them.
/// Error: registered images of two shapes, or a camera that such images cannot have; names `source`.
[[nodiscard]] Result<std::optional<ColorCamera>> colorCameraFor(const ColorRegistration& registration,
                                                                const cv::Size& size,
                                                                const Intrinsics& depth_K,
                                                                const std::string& source);

}  // namespace scantrove
