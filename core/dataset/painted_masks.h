#pragma once
#include <opencv2/core/mat.hpp>
#include <span>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// Applies what a person painted to the regions of an image (CV_32SC1), in its order: the later one holds
/// where two overlap. Added pixels take the painted region, or keep one that was split from it since. Removed
/// pixels that still show it take the region that borders on most of their component; 0 if it encloses them.
/// Masks of another size are left out. Costs time in proportion to the painted boxes.
void applyPaintedMasks(std::span<const PaintedMask> masks, cv::Mat& regions);

}  // namespace scantrove
