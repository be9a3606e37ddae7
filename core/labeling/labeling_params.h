#pragma once

namespace scantrove {

/// Merging of segments over time (thesis 3.3).
struct LabelingParams {
  enum class Rule {
    graph,   ///< regions are parts of a graph of evidence between fragments; joins can be undone
    thesis,  ///< join at once and for good where the overlap rule holds (thesis 3.3.2, literal)
  };
  Rule rule = Rule::graph;
  float overlap_threshold = 0.3F;  ///< O_thresh
  /// Log-odds of one object must exceed this to join fragments, and fall below its negative to separate them.
  float hysteresis = 0.5F;
  float joining_bias = 0;     ///< added to the log-odds of every border: above 0 joins more
  int min_fragment_px = 120;  ///< smaller segments without overlap start no fragment (640x480 equivalent)
  bool voxel_confidence =
      true;  ///< agree +1, disagree -1, replace at 0; false = overwrite as Algorithm 1 does
  float update_distance_vox = 1.0F;  ///< distthresh in voxels; at least sqrt(3)/2
  /// Least distthresh over depth: half the diagonal of a depth pixel at 1 m, so that voxels between pixels
  /// get labels. 0: none. A MappingPipeline sets it by its camera.
  float reach_of_depth = 0;
};

}  // namespace scantrove
