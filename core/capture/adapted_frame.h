#pragma once
#include <opencv2/core/types.hpp>

#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"

namespace scantrove {

/// Changes `frame`, which the depth camera `own` took, to what the depth camera `wanted` at the same place
/// would have taken. Depth is read at the nearest pixel; parts that `own` does not see have none. The colour
/// image gets `color_size`; empty: it keeps its size. Both cameras have the frame's pose.
void adaptToCamera(RgbdFrame& frame, const Intrinsics& own, const Intrinsics& wanted, cv::Size color_size);

}  // namespace scantrove
