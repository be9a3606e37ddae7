#pragma once
#include <Eigen/Core>
#include <span>

#include "core/fusion/rendered_view.h"
#include "core/segmentation/segment_map.h"
#include "core/segmentation/support_finder.h"

namespace scantrove {

/// Corrects the segments of a frame where a support (a table, a shelf, the floor) tells more than depth
/// alone:
/// - what stands out from a support, by height or by colour, and touches the support all around is one
/// segment, flat
///   objects included;
/// - its pixels without depth (shiny, dark or transparent surface) belong to it. They get an estimated depth,
/// from the
///   height of the measured pixels nearby, or else from the support; SegmentMap::is_estimated marks them;
/// - the rest of the support is one segment, and takes in the small segments around missing depth.
/// `supports`: findSupports() of these segments. `color_lab`: CIE L*a*b* of each pixel, also of those without
/// surface; empty: height alone decides. Any thread.
void segmentOnSupports(std::span<const Support> supports, std::span<const Eigen::Vector3f> color_lab,
                       const Intrinsics& K, SegmentMap& segments);

/// Gives the estimated pixels of `segments` a vertex in `view`, of the same size, and marks them there. They
/// have no normal.
void addEstimatedSurface(const SegmentMap& segments, RenderedView& view);

}  // namespace scantrove
