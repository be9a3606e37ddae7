#pragma once
#include "core/catalogue/detection_params.h"
#include "core/fusion/fusion_params.h"
#include "core/pipeline/mapping_params.h"

namespace scantrove {

/// All parameters of a scan: one immutable value, replaced whole.
struct ScanParams : MappingParams {
  /// The map fits the sensor unless the user sets a parameter.
  ScanParams() {
    fusion.voxel_size_m = kAutomatic;
    fusion.min_depth_m = kAutomatic;
    fusion.max_depth_m = kAutomatic;
    fusion.depth_noise_m = kAutomatic;
  }

  DetectionParams detection;
};

}  // namespace scantrove
