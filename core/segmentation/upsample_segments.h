#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace scantrove {

/// A depth image of the same view at the resolution that is wanted.
struct DepthGuide {
  int width = 0;
  int height = 0;
  std::span<const std::uint16_t> depth;  ///< width * height, row by row; 0 = no reading
  float metres_per_unit = 0.001F;
};

/// `ids` (of width x height pixels at `depths_m`, 0 = no surface: segments, or regions of the same frame) at
/// the guide's resolution. A pixel with a reading takes the id of that pixel with a surface, at most 3 around
/// its nearest, which is closest in image and depth together: outlines follow the depth image, and the
/// surface that the map misses along depth edges is given back. Pixels without reading take the nearest.
/// Result: guide.width * guide.height.
[[nodiscard]] std::vector<std::uint32_t> upsampleByDepth(std::span<const std::uint32_t> ids,
                                                         std::span<const float> depths_m, int width,
                                                         int height, const DepthGuide& guide);

}  // namespace scantrove
