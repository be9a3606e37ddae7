#pragma once
#include <functional>
#include <vector>

#include "core/collection/seen_object.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// The objects that the regions of a view are, by their numbers, each with its regions there and the
/// rectangle in the colour image around what that shows of it; what the catalogue says of them is left open.
/// `object_of`: none: the region is no object. `in_color`: of the same pixels. An object of fewer than
/// `least_pixels` is left out: that is a rest of something. Any thread.
[[nodiscard]] std::vector<SeenObject> objectsInView(const RenderedView& view, const SurfaceInColor& in_color,
                                                    const std::function<ObjectId(RegionId)>& object_of,
                                                    int least_pixels);

}  // namespace scantrove
