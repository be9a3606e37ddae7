#include "core/pipeline/editable_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/fusion/kernels/color_voxel.h"

namespace scantrove {
namespace {

Eigen::Vector3i brickOf(const Eigen::Vector3i& voxel) {
  return {voxel.x() >> BRICK_SHIFT, voxel.y() >> BRICK_SHIFT, voxel.z() >> BRICK_SHIFT};
}

std::optional<std::array<std::uint8_t, 3>> rgbOf(std::uint32_t color) {
  if (COLOR_WEIGHT(color) == 0) return std::nullopt;
  return std::array{static_cast<std::uint8_t>(COLOR_RED(color)),
                    static_cast<std::uint8_t>(COLOR_GREEN(color)),
                    static_cast<std::uint8_t>(COLOR_BLUE(color))};
}

bool comesFirst(const SurfaceVoxel& a, const SurfaceVoxel& b) {
  return std::lexicographical_compare(a.voxel.data(), a.voxel.data() + 3, b.voxel.data(), b.voxel.data() + 3);
}

}  // namespace

std::vector<bool> EditableCloud::collect(std::span<const Eigen::Vector3i> bricks,
                                         std::span<const FragmentId> fragments,
                                         std::vector<SurfaceVoxel>& voxels) {
  const LabelCloud::Extract extract = cloud_.extract(bricks, bricks_, truncation_vox_);
  std::vector<bool> has_some(bricks.size(), false);
  for (std::size_t brick = 0; brick < bricks.size(); ++brick) {
    for (std::uint32_t i = extract.first[brick]; i < extract.first[brick + 1]; ++i) {
      const LabelPoint& point = extract.points[i];
      if (!std::ranges::binary_search(fragments, FragmentId{point.fragment})) continue;
      has_some[brick] = true;
      const Eigen::Vector3f place = Eigen::Vector3f(point.x, point.y, point.z) / bricks_.voxelSize();
      voxels.push_back({place.array().floor().cast<int>(),
                        {point.normal_x, point.normal_y, point.normal_z},
                        FragmentId{point.fragment},
                        rgbOf(point.color)});
    }
  }
  return has_some;
}

std::vector<SurfaceVoxel> EditableCloud::surfaceOf(std::span<const FragmentId> fragments,
                                                   std::span<const Eigen::Vector3f> places) {
  std::vector<SurfaceVoxel> voxels;
  if (places.empty()) {
    for (const int page : bricks_.pagesByPosition()) {
      const std::vector<Eigen::Vector3i> bricks = bricks_.bricksOfPage(page);
      collect(bricks, fragments, voxels);
    }
  } else {
    std::unordered_set<Eigen::Vector3i, BrickHash> seen;
    std::vector<Eigen::Vector3i> front;
    const auto addAround = [&](const Eigen::Vector3i& brick, std::vector<Eigen::Vector3i>& to) {
      for (int i = 0; i < 27; ++i) {
        const Eigen::Vector3i next = brick + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (seen.insert(next).second) to.push_back(next);
      }
    };
    for (const Eigen::Vector3f& place : places) {
      const Eigen::Vector3f voxel = place / bricks_.voxelSize();
      addAround(brickOf(voxel.array().floor().cast<int>()), front);
    }
    while (!front.empty()) {
      sortBricks(front);
      const std::vector<bool> has_some = collect(front, fragments, voxels);
      std::vector<Eigen::Vector3i> next;
      for (std::size_t i = 0; i < front.size(); ++i) {
        if (has_some[i]) addAround(front[i], next);
      }
      front = std::move(next);
    }
  }
  std::ranges::sort(voxels, comesFirst);
  return voxels;
}

void EditableCloud::relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) {
  cloud_.relabel(voxels, fragment, bricks_);
  std::vector<Eigen::Vector3i> bricks;
  for (const Eigen::Vector3i& voxel : voxels) bricks.push_back(brickOf(voxel));
  sortBricks(bricks);
  bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
}

}  // namespace scantrove
