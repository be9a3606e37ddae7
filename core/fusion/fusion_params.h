#pragma once

namespace scantrove {

/// Dense mapping: depth filter, tracker, brick map (thesis 2.2 and 3.1).
struct FusionParams {
  float voxel_size_m = 3.0F / 512.0F;
  float truncation_vox = 4.0F;  ///< half width of the signed-distance band
  float max_weight = 64.0F;     ///< running average over at most so many frames
  float min_depth_m = 0.3F;
  float max_depth_m = 5.0F;  ///< depth beyond this is neither fused nor tracked
  int working_width = 320;   ///< width of V_t and N_t, and of tracking and segmentation
};

}  // namespace scantrove
