#include "core/meshing/voxel_block.h"

#include <algorithm>

namespace scantrove {
namespace {

constexpr std::size_t kBlockVoxels = std::size_t{VoxelBlock::kSide} * VoxelBlock::kSide * VoxelBlock::kSide;
constexpr int kLow = -VoxelBlock::kMargin;
constexpr int kHigh = VoxelBlock::kPageVoxels + VoxelBlock::kMargin;  // the last voxel

Eigen::Vector3i placeInPage(std::size_t local) {
  const int i = static_cast<int>(local);
  return {i % PAGE_SIDE, i / PAGE_SIDE % PAGE_SIDE, i / (PAGE_SIDE * PAGE_SIDE)};
}

}  // namespace

VoxelBlock::VoxelBlock() : distances_(kBlockVoxels), labels_(kBlockVoxels), colors_(kBlockVoxels) {}

void VoxelBlock::load(PageReader& reader, int page) {
  std::ranges::fill(distances_, cl_short{DISTANCE_UNSEEN});
  std::ranges::fill(labels_, 0U);
  std::ranges::fill(colors_, 0U);
  has_labels_ = has_colors_ = false;
  const BrickPages& pages = reader.map().pages();
  const Eigen::Vector3i position = pages.page(page).position;
  first_voxel_ = kPageVoxels * position;
  bricks_ = reader.page(page).bricks;
  for (int neighbor = 0; neighbor < 27; ++neighbor) {
    const Eigen::Vector3i offset(neighbor % 3 - 1, neighbor / 3 % 3 - 1, neighbor / 9 - 1);
    const int index = pages.pageWith(PAGE_SIDE * (position + offset));
    if (index == BRICK_NONE) continue;
    const StoredPage& stored = reader.page(index);
    std::size_t number = 0;
    for (std::size_t local = 0; local < PAGE_BRICKS; ++local) {
      if (!stored.bricks[local]) continue;
      copyBrick(stored.contents, number++, kPageVoxels * offset + BRICK_SIDE * placeInPage(local));
    }
  }
}

void VoxelBlock::copyBrick(const BrickContents& held, std::size_t number, const Eigen::Vector3i& first) {
  const Eigen::Vector3i from = first.cwiseMax(kLow);
  const Eigen::Vector3i to = (first + Eigen::Vector3i::Constant(BRICK_SIDE - 1)).cwiseMin(kHigh);
  if ((to.array() < from.array()).any()) return;
  const int length = to.x() - from.x() + 1;
  const auto count = static_cast<std::size_t>(length);
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      const Eigen::Vector3i local(from.x() - first.x(), y - first.y(), z - first.z());
      const std::size_t source =
          number * BRICK_VOXELS +
          static_cast<std::size_t>(local.x() + BRICK_SIDE * (local.y() + BRICK_SIDE * local.z()));
      const std::size_t target = at({from.x(), y, z});
      std::copy_n(&held.distances[source], count, &distances_[target]);
      for (std::size_t i = 0; i < count; ++i) {
        labels_[target + i] = held.labels[source + i];
        colors_[target + i] = held.colors[source + i];
        has_labels_ |= held.labels[source + i] != 0;
        has_colors_ |= held.colors[source + i] != 0;
      }
    }
  }
}

}  // namespace scantrove
