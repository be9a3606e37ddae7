#pragma once
#include <functional>
#include <vector>

#include "core/collection/seen_object.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// The objects of a view by number, each with its regions there and their rectangle in the colour image;
/// catalogue data is not filled in. `object_of` returns none for a region that is no object. `in_color` has
/// the same pixels. Objects under `least_pixels` are left out as remnants, and stray pixels
/// do not count for the rectangle. Any thread.
[[nodiscard]] std::vector<SeenObject> objectsInView(const RenderedView& view, const SurfaceInColor& in_color,
                                                    const std::function<ObjectId(RegionId)>& object_of,
                                                    int least_pixels);

}  // namespace scantrove
