#pragma once
#include <optional>

#include "core/base/result.h"
#include "core/dataset/labeled_scan.h"
#include "core/editing/operation.h"
#include "core/editing/painted_surface.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

class OpenSession;

/// The surface of the map behind the image of a key frame in which a person painted. `view`: the map from the
/// image's camera, with vertices and regions, at any resolution. `depth_m`: CV_32FC1 of the image's size, its
/// registered depth in metres, 0 = no reading; where it shows something in front of the map, the map is
/// hidden. Pixels within the error of the registration (8 mm) from a painted outline are unclear; a mask
/// thinner than that keeps its middle.
[[nodiscard]] PaintedSurface paintedSurface(const RenderedView& view, const cv::Mat& depth_m, RegionId region,
                                            const MaskCorrection& correction);

/// The same for a paint of the session; none: it corrects its image alone. Error: the operation is none of
/// this session (no such key frame, masks of another size), its depth image cannot be read, or the device.
[[nodiscard]] Result<std::optional<PaintedSurface>> paintedSurfaceOf(OpenSession& session,
                                                                     const Operation& paint);

}  // namespace scantrove
