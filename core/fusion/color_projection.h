#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/capture/color_camera.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Projection of the depth camera's surface into the colour image.
struct SurfaceInColor {
  /// h x w, CV_32FC2: (column + 0.5) / width and (row + 0.5) / height of the colour image, by pixel of the
  /// depth camera. Pixels without surface are projected from infinity.
  cv::Mat places;
  cv::Mat hidden;  ///< h x w, CV_8UC1, 255 = outside the colour image, or occluded in it
};

/// Projects the surface of `view`. Does not read its vertices if colour is registered (no `camera`).
[[nodiscard]] SurfaceInColor locateInColor(const std::optional<ColorCamera>& camera,
                                           const RenderedView& view);

/// Converts places to CV_32FC2 pixels (centres at integers) of the colour image scaled to `size`.
[[nodiscard]] cv::Mat pixelsOf(const cv::Mat& places, const cv::Size& size);

}  // namespace scantrove
