#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/capture/color_camera.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Where the surface that a depth camera sees is seen in the colour image.
struct SurfaceInColor {
  /// h x w, CV_32FC2: (column + 0.5) / width and (row + 0.5) / height of the colour image, by pixel of the
  /// depth camera. Where there is no surface, as if it were infinitely far.
  cv::Mat places;
  cv::Mat hidden;  ///< h x w, CV_8UC1, 255 = the colour image ends before it, or shows something nearer there
};

/// Where the surface of `view` is seen. Its vertices are not read when colour is registered (no `camera`).
[[nodiscard]] SurfaceInColor locateInColor(const std::optional<ColorCamera>& camera,
                                           const RenderedView& view);

/// Places as CV_32FC2 pixels of an image of `size` (centres at integers) that shows what the colour image
/// does.
[[nodiscard]] cv::Mat pixelsOf(const cv::Mat& places, const cv::Size& size);

}  // namespace scantrove
