#pragma once
#include "core/catalogue/detection_params.h"
#include "core/pipeline/mapping_params.h"

namespace scantrove {

/// All parameters of a scan: one immutable value, replaced whole.
struct ScanParams : MappingParams {
  DetectionParams detection;
};

}  // namespace scantrove
