#include "core/segmentation/graph_segmenter.h"

#include <array>
#include <utility>

#include "core/segmentation/edge_keys.h"

namespace scantrove {

GraphSegmenter::GraphSegmenter(NormalRefiner refiner, EdgeWeigher weigher)
    : refiner_(std::move(refiner)), weigher_(std::move(weigher)) {}

Result<std::unique_ptr<GraphSegmenter>> GraphSegmenter::create(ComputeContext& compute) {
  Result<NormalRefiner> refiner = NormalRefiner::create(compute);
  if (!refiner) return fail(refiner.error());
  Result<EdgeWeigher> weigher = EdgeWeigher::create(compute);
  if (!weigher) return fail(weigher.error());
  return std::unique_ptr<GraphSegmenter>(new GraphSegmenter(std::move(*refiner), std::move(*weigher)));
}

void GraphSegmenter::weigh(const SurfaceMaps& surface, const SegmentationParams& params) {
  const bool refine = params.refine_normals && surface.K.pixels() > 0;
  weigher_.weigh(surface, refine ? refiner_.refine(surface, params) : surface.normals_world, params, edges_);
}

SegmentMap GraphSegmenter::partition(const SegmentationParams& params) {
  if (params.rule == SegmentationParams::Rule::whole) return wholeSurface();
  const std::span<const std::uint16_t> keys(
      edges_.keys.empty() ? nullptr : reinterpret_cast<const std::uint16_t*>(edges_.keys.data()),
      edges_.keys.size() * EDGE_DIRECTIONS);
  sortEdges(keys, counts_, order_);
  components_.reset(edges_.keys.size(), params.k);

  const auto width = static_cast<std::uint32_t>(edges_.width);
  const std::array<std::uint32_t, EDGE_DIRECTIONS> offset = {1, width, width + 1, width - 1};
  rejected_.clear();
  for (const std::uint32_t edge : order_) {
    const std::uint32_t pixel = edge / EDGE_DIRECTIONS;
    if (!components_.join(pixel, pixel + offset[edge % EDGE_DIRECTIONS], edgeWeight(keys[edge]))) {
      rejected_.push_back(edge);
    }
  }
  const auto min_pixels = static_cast<std::uint32_t>(std::max(params.min_pixels, 0));
  for (const std::uint32_t edge : rejected_) {
    const std::uint32_t pixel = edge / EDGE_DIRECTIONS;
    components_.absorb(pixel, pixel + offset[edge % EDGE_DIRECTIONS], edgeWeight(keys[edge]), min_pixels);
  }
  return number();
}

SegmentMap GraphSegmenter::wholeSurface() const {
  SegmentMap map;
  map.width = edges_.width;
  map.height = edges_.height;
  map.depths_m = edges_.depths_m;
  map.ids.reserve(map.depths_m.size());
  map.areas.assign(2, 0);
  for (const float depth_m : map.depths_m) {
    const std::uint32_t id = depth_m > 0 ? 1 : 0;
    map.ids.push_back(id);
    ++map.areas[id];
  }
  if (map.areas[1] == 0) map.areas.pop_back();
  return map;
}

SegmentMap GraphSegmenter::number() {
  SegmentMap map;
  map.width = edges_.width;
  map.height = edges_.height;
  map.ids.assign(edges_.depths_m.size(), 0);
  map.areas.assign(1, 0);
  map.depths_m = edges_.depths_m;
  id_of_root_.assign(edges_.depths_m.size(), 0);
  for (std::size_t pixel = 0; pixel < map.ids.size(); ++pixel) {
    std::uint32_t id = 0;
    if (edges_.depths_m[pixel] > 0) {
      std::uint32_t& known = id_of_root_[components_.find(static_cast<std::uint32_t>(pixel))];
      if (known == 0) {
        known = static_cast<std::uint32_t>(map.areas.size());
        map.areas.push_back(0);
      }
      id = known;
    }
    map.ids[pixel] = id;
    ++map.areas[id];
  }
  return map;
}

}  // namespace scantrove
