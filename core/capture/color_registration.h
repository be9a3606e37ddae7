#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/color_camera.h"

namespace scantrove {

/// Factory values of a Kinect v1's colour camera: 528 pixels focal length at 640x480, 25 mm beside the depth
/// camera. Single devices may differ by a few pixels.
[[nodiscard]] ColorCamera kinectColorCamera();

/// Reads "registered", "kinect", or numbers: fx,fy,cx,cy,x or with y,z or with y,z,rx,ry,rz. Pixels of the
/// colour images; then T_color_depth in metres and in degrees about the axis (rx, ry, rz). Error: names
/// `text` and lists the accepted forms.
[[nodiscard]] Result<ColorRegistration> parseColorRegistration(const std::string& text);

/// The camera of colour images of `size` for depth images of `depth_K`; none: registered. Error: registered
/// images differ by more than 1 % in aspect ratio, or the camera is impossible for this size; names `source`.
[[nodiscard]] Result<std::optional<ColorCamera>> colorCameraFor(const ColorRegistration& registration,
                                                                const cv::Size& size,
                                                                const Intrinsics& depth_K,
                                                                const std::string& source);

}  // namespace scantrove
