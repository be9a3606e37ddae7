#pragma once
#include "core/discovery/discovery_params.h"
#include "core/fusion/fusion_params.h"
#include "core/labeling/labeling_params.h"
#include "core/segmentation/segmentation_params.h"

namespace scantrove {

/// The parameters of a mapping pipeline: one immutable value, replaced whole.
struct MappingParams {
  FusionParams fusion;
  SegmentationParams segmentation;
  LabelingParams labeling;
  DiscoveryParams discovery;
};

}  // namespace scantrove
