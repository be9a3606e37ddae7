#pragma once

namespace scantrove {

/// Segmentation of one frame (thesis 3.2).
struct SegmentationParams {
  enum class Rule {
    graph,  ///< thesis 3.2
    whole,  ///< all surface of a frame is one segment: one object is scanned alone
  };
  Rule rule = Rule::graph;
  float k = 0.6F;     ///< the only parameter in the window: larger k, larger segments (eq. 3.4)
  int neighbors = 8;  ///< 4 or 8
  float max_distance_factor = 3.0F;  ///< d_max = factor * z / f ...
  float min_max_distance_m = 0.01F;  ///< ... but at least this
  int min_pixels = 30;               ///< smaller components are absorbed by their most similar neighbour

  bool refine_normals = true;  ///< weigh with normals fitted to V_t (refine_normals.cl) instead of N_t
  /// Vertices nearer or farther by more than this (times z^2 beyond 1 m) belong to another surface.
  float normal_gate_m = 0.01F;
  /// A window whose rim rises by at least this is concave; its normals are kept sharp.
  float concave_from_m = 0.0003F;

  bool operator==(const SegmentationParams&) const = default;
};

}  // namespace scantrove
