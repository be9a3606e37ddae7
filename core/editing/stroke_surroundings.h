#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/editing/surface_graph.h"

namespace scantrove {

/// The voxels that surround what one stroke covers: the other seeds of a split by a single stroke. They
/// differ from all main colours under the stroke, and every path to them crosses a colour edge. Small pieces
/// among them that other surroundings exceed are left out, because print and pictures are part of a page.
/// Rising; empty if there are none, or if the stroke or the graph has no colour. Any thread.
[[nodiscard]] std::vector<std::uint32_t> surroundingsOf(const SurfaceGraph& graph,
                                                        std::span<const std::uint32_t> stroke);

}  // namespace scantrove
