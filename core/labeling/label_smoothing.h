#pragma once
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Cleans the fragments of an image: pixels with fewer than three of eight neighbours of their
/// fragment take the fragment that most neighbours on the same surface have. Such pixels come from voxels
/// between pixels, and from outlines that differ between frames. `view`: vertices of the pixels.
void removeIsolatedLabels(const RenderedView& view, std::vector<FragmentId>& fragments);

/// The same for a picture of regions, on whatever surface they are: pixels with fewer than three equal
/// neighbours take the region that most neighbours have, or none. `regions`: rows of `width` pixels.
void removeIsolatedLabels(int width, std::vector<RegionId>& regions);

}  // namespace scantrove
