#pragma once
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace scantrove {

/// A rough mask with its outline moved to edges of the image.
struct SnappedMask {
  cv::Rect box;  ///< the pixels that may differ; empty: `rough` is empty or has no outline
  cv::Mat mask;  ///< CV_8UC1 of the box's size, 255 = inside
};

/// Moves the outline of a rough mask (what a stroke or polygon encloses) to edges of the image nearby: the
/// magic edge. Only pixels within `reach_px` of the outline are decided, by a minimum cut between what lies
/// farther inside and farther outside. It is cheap along edges of colour (Boykov and Jolly 2001), and a pixel
/// prefers the side that has its colour nearby. A mask thinner than the band keeps its middle. Where nothing
/// tells both sides apart, the outline stays. `color`: CV_8UC3; `rough`: CV_8UC1, nonzero = inside, of one
/// size. Only the box of the mask costs time. Any thread.
[[nodiscard]] SnappedMask snapToEdges(const cv::Mat& color, const cv::Mat& rough, int reach_px);

}  // namespace scantrove
