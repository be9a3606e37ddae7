#pragma once

namespace scantrove {

/// Segmentation of one frame (thesis 3.2).
struct SegmentationParams {
  float k = 0.6F;                    ///< the one parameter a person sees: larger k, larger segments (eq. 3.4)
  int neighbors = 8;                 ///< 4 or 8
  float max_distance_factor = 3.0F;  ///< d_max = factor * z / f ...
  float min_max_distance_m = 0.01F;  ///< ... but at least this
  int min_pixels = 30;               ///< smaller components are absorbed by their most similar neighbour

  bool refine_normals = true;  ///< weigh with normals fitted to V_t (refine_normals.cl) instead of N_t
  /// Vertices so much nearer or farther (times z^2 beyond 1 m) are another surface.
  float normal_gate_m = 0.01F;
  /// A window whose rim stands out so far is concave: its normals are kept sharp.
  float concave_from_m = 0.0003F;

  bool operator==(const SegmentationParams&) const = default;
};

}  // namespace scantrove
