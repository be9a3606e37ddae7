#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "core/segmentation/edge_weigher.h"
#include "core/segmentation/graph_partition.h"
#include "core/segmentation/normal_refiner.h"
#include "core/segmentation/segment_map.h"
#include "core/segmentation/segmentation_params.h"

namespace scantrove {

/// Single-frame segmentation S_t of V_t, N_t: edge weights of eq. 3.5 on the device, then the graph
/// segmentation of Felzenszwalb and Huttenlocher (eq. 3.1 - 3.4) on the host. Deterministic. One thread, the
/// compute context's, but for partition().
class GraphSegmenter {
 public:
  [[nodiscard]] static Result<std::unique_ptr<GraphSegmenter>> create(ComputeContext& compute);

  [[nodiscard]] SegmentMap segment(const SurfaceMaps& surface, const SegmentationParams& params) {
    weigh(surface, params);
    return partition(params);
  }

  /// The two steps of segment(): weigh() on the device, then partition() on the host, which may run in
  /// another thread.
  void weigh(const SurfaceMaps& surface, const SegmentationParams& params);
  [[nodiscard]] SegmentMap partition(const SegmentationParams& params);

 private:
  GraphSegmenter(NormalRefiner refiner, EdgeWeigher weigher);

  /// Numbers the components 1, 2, ... by their first pixel.
  [[nodiscard]] SegmentMap number();
  /// All surface as segment 1.
  [[nodiscard]] SegmentMap wholeSurface() const;

  NormalRefiner refiner_;
  EdgeWeigher weigher_;
  EdgeKeys edges_;
  GraphPartition components_;
  // Working memory, kept between frames.
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> rejected_;
  std::vector<std::uint32_t> id_of_root_;
};

}  // namespace scantrove
