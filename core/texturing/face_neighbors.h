#pragma once
#include <limits>
#include <span>
#include <vector>

#include "core/texturing/texture_surface.h"

namespace scantrove {

inline constexpr std::uint32_t kNoFace = std::numeric_limits<std::uint32_t>::max();

/// For each face the faces across its edges; edge i leads from corner i to the next one. kNoFace: none.
using FaceNeighbors = std::vector<std::array<std::uint32_t, 3>>;

/// An edge of more than two faces joins them in pairs.
[[nodiscard]] FaceNeighbors neighborsOf(std::span<const FaceCorners> faces);

}  // namespace scantrove
