#pragma once
#include <memory>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "core/segmentation/segment_map.h"
#include "core/segmentation/segmentation_params.h"

namespace scantrove {

/// Single-frame segmentation S_t of V_t, N_t: edge weights of eq. 3.5 on the device, then the graph
/// segmentation of Felzenszwalb and Huttenlocher (eq. 3.1 - 3.4) on the host. Deterministic. One thread, the
/// compute context's.
class GraphSegmenter {
 public:
  [[nodiscard]] static Result<std::unique_ptr<GraphSegmenter>> create(ComputeContext& compute);
  ~GraphSegmenter();

  [[nodiscard]] SegmentMap segment(const SurfaceMaps& surface, const SegmentationParams& params);

 private:
  GraphSegmenter() = default;
  class Machinery;
  std::unique_ptr<Machinery> machinery_;
};

}  // namespace scantrove
