#pragma once
#include <span>
#include <vector>

#include "core/fusion/brick_map.h"

namespace scantrove::test {

/// What a pool of the map holds in the slots that were ever handed out.
template <class T>
[[nodiscard]] std::vector<T> usedPart(ComputeContext& compute, const BrickMap& map, const Buffer<T>& pool) {
  std::vector<T> voxels(static_cast<std::size_t>(map.slotEnd()) * BRICK_VOXELS);
  pool.read(compute.queue(), std::span<T>(voxels));
  return voxels;
}

}  // namespace scantrove::test
