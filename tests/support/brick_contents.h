#pragma once
#include <span>
#include <vector>

#include "core/fusion/brick_map.h"
#include "core/fusion/brick_window.h"

namespace scantrove::test {

/// What a pool of the map holds in the slots that were ever handed out.
template <class T>
[[nodiscard]] std::vector<T> usedPart(ComputeContext& compute, const BrickMap& map, const Buffer<T>& pool) {
  std::vector<T> voxels(static_cast<std::size_t>(map.device().slotEnd()) * BRICK_VOXELS);
  pool.read(compute.queue(), std::span<T>(voxels));
  return voxels;
}

/// What is fused of a voxel, as it lies in the pools (brick_layout.h).
struct HostVoxel {
  int distance = DISTANCE_UNSEEN;
  int weight = 0;
  bool operator==(const HostVoxel&) const = default;
};

/// Of the slots that were ever handed out.
[[nodiscard]] inline std::vector<HostVoxel> usedVoxels(ComputeContext& compute, const BrickMap& map) {
  const std::vector<cl_short> distances = usedPart(compute, map, map.pools().distances());
  const std::vector<cl_uchar> weights = usedPart(compute, map, map.pools().weights());
  std::vector<HostVoxel> voxels;
  for (std::size_t i = 0; i < distances.size(); ++i) voxels.push_back({distances[i], weights[i]});
  return voxels;
}

/// To the slots from 0 on.
inline void writeVoxels(ComputeContext& compute, BrickMap& map, const std::vector<HostVoxel>& voxels) {
  std::vector<cl_short> distances;
  std::vector<cl_uchar> weights;
  for (const HostVoxel& voxel : voxels) {
    distances.push_back(static_cast<cl_short>(voxel.distance));
    weights.push_back(static_cast<cl_uchar>(voxel.weight));
  }
  map.pools().distances().write(compute.queue(), distances);
  map.pools().weights().write(compute.queue(), weights);
}

/// Of all pages.
[[nodiscard]] inline BrickWindow windowOfAll(ComputeContext& compute, const BrickMap& map) {
  std::vector<int> pages;
  for (int page = 1; page < map.pages().count(); ++page) pages.push_back(page);
  BrickWindow window;
  window.set(compute, map.pages(), pages);
  return window;
}

}  // namespace scantrove::test
