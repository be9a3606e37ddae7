#pragma once
#include "core/catalogue/detection_params.h"
#include "core/discovery/discovery_params.h"
#include "core/fusion/fusion_params.h"
#include "core/labeling/labeling_params.h"
#include "core/segmentation/segmentation_params.h"

namespace scantrove {

/// Every parameter of a scan: one immutable value, replaced whole.
struct ScanParams {
  FusionParams fusion;
  SegmentationParams segmentation;
  LabelingParams labeling;
  DiscoveryParams discovery;
  DetectionParams detection;
};

}  // namespace scantrove
