#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <span>
#include <vector>

namespace scantrove {

/// Packs rectangles without overlap into one of the size `bin`, tall ones first, each as near to its first
/// row as those placed before allow (the skyline method). The corners with the smallest coordinates, in the
/// order of `sizes`; none: they do not fit.
[[nodiscard]] std::optional<std::vector<cv::Point>> packRects(std::span<const cv::Size> sizes,
                                                              const cv::Size& bin);

}  // namespace scantrove
