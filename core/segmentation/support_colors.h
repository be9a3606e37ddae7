#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// A pixel that differs more from its support is of something else.
inline constexpr float kClearColorDifference = 4;

/// How far the colour of each pixel differs from that of the support around it, as a multiple of the
/// support's own variation there. Grain and patterns therefore count for little. 0 where nothing is known.
struct SupportColorDifference {
  cv::Mat1f lit;     ///< under the support's light
  cv::Mat1f shaded;  ///< at most `lit`: the pixel may also lie in shadow
};

/// `lab`: CIE L*a*b* of each pixel, also of those without surface. `flat`: 255 on the support's measured
/// surface. `area`: 255 on the pixels to compare.
[[nodiscard]] SupportColorDifference differenceFromSupport(const cv::Mat3f& lab, const cv::Mat1b& flat,
                                                           const cv::Mat1b& area);

}  // namespace scantrove
