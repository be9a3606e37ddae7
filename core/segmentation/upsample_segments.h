#pragma once
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// `segments` at width x height, each pixel from the nearest of the source (pixel centres as
/// Intrinsics::resizedTo has them). Areas are counted anew; ids stay, so an id may have area 0 when the
/// result is smaller than the source.
[[nodiscard]] SegmentMap upsample(const SegmentMap& segments, int width, int height);

}  // namespace scantrove
