#pragma once
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The fragments of an image, row by row, without small components. 4-connected components under `least_px`
/// pixels become none if their fragment has a larger one in view. They come from voxels with a wrong label
/// and would falsify contacts.
[[nodiscard]] std::vector<FragmentId> withoutSmallPieces(std::span<const FragmentId> fragments, int width,
                                                         int least_px);

}  // namespace scantrove
