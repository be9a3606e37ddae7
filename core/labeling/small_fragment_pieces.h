#pragma once
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The fragments of an image, row by row, without specks: pieces of less than `least_px` pixels (that hang
/// together by their sides) of fragments that have a larger piece in view become none. Where two fragments
/// meet is not to be told from voxels that took the wrong one's label.
[[nodiscard]] std::vector<FragmentId> withoutSmallPieces(std::span<const FragmentId> fragments, int width,
                                                         int least_px);

}  // namespace scantrove
