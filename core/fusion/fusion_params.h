#pragma once

namespace scantrove {

/// Value of a parameter that fitToSensor() replaces.
inline constexpr float kAutomatic = -1;

/// Dense mapping: depth filter, tracker, brick map (thesis 2.2 and 3.1). The defaults fit a Kinect.
struct FusionParams {
  float voxel_size_m = 3.0F / 512.0F;
  float truncation_vox = 4.0F;  ///< half width of the signed-distance band
  float max_weight = 64.0F;     ///< running average over at most this many frames
  float min_depth_m = 0.3F;
  float max_depth_m = 5.0F;  ///< depth beyond this is neither fused nor tracked
  /// Standard deviation of the camera's depth at 1 m; it grows with the depth squared. The default suits
  /// structured light (Khoshelham and Elberink 2012 measured 0.0014 on a Kinect). Thresholds of depth filter,
  /// tracker and pose judgement derive from it.
  float depth_noise_m = 0.0015F;
  /// Device memory of the map, in MiB; beyond it, bricks out of view move to disk. 0: a quarter of the
  /// machine's memory.
  int memory_budget_mb = 0;
  int working_width = 320;  ///< width of V_t and N_t, and of tracking and segmentation
};

}  // namespace scantrove
