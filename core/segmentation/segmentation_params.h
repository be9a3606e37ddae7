#pragma once

namespace scantrove {

/// Segmentation of one frame (thesis 3.2).
struct SegmentationParams {
  float k = 0.01F;                   ///< the one parameter a person sees: larger k, larger segments (eq. 3.4)
  int neighbours = 8;                ///< 4 or 8
  float max_distance_factor = 3.0F;  ///< d_max = factor * z / f ...
  float min_max_distance_m = 0.01F;  ///< ... but at least this
  int min_pixels = 20;               ///< smaller components are absorbed by their most similar neighbour
};

}  // namespace scantrove
