#pragma once

namespace scantrove {

/// Merging of segments over time (thesis 3.3).
struct LabelingParams {
  enum class Rule {
    thesis,    ///< join at once where the overlap rule holds
    evidence,  ///< join regions after the rule held for the pair in `evidence_frames` frames
  };
  Rule rule = Rule::evidence;
  float overlap_threshold = 0.3F;  ///< O_thresh
  int evidence_frames = 5;
  bool voxel_confidence =
      true;  ///< agree +1, disagree -1, replace at 0; false = overwrite as Algorithm 1 does
  float update_distance_vox = 1.0F;  ///< distthresh in voxels; at least sqrt(3)/2
};

}  // namespace scantrove
