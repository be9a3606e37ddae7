#pragma once
#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/compute/opencl.h"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/kernels/brick_page.h"
#include "core/meshing/page_reader.h"

namespace scantrove {

struct BrickContents;

/// The voxels of one page of bricks on the host, with a margin from the adjacent pages, so that processing a
/// page needs no tests at its border. Missing voxels count as unseen.
class VoxelBlock {
 public:
  static constexpr int kPageVoxels = PAGE_SIDE * BRICK_SIDE;
  /// Voxels of the margin on the lower side of the page; on the upper side there is one more.
  static constexpr int kMargin = 2;
  static constexpr int kSide = kPageVoxels + 2 * kMargin + 1;

  VoxelBlock();

  /// Loads a page with its margin.
  void load(PageReader& reader, int page);

  /// Bricks of the page itself, by local index.
  [[nodiscard]] const std::bitset<PAGE_BRICKS>& bricks() const { return bricks_; }
  /// Position of the page's first voxel.
  [[nodiscard]] const Eigen::Vector3i& firstVoxel() const { return first_voxel_; }

  /// Index of a voxel; `local` counts from the page's first, in [-kMargin, kPageVoxels + kMargin].
  [[nodiscard]] static std::size_t at(const Eigen::Vector3i& local) {
    const Eigen::Matrix<std::size_t, 3, 1> p = (local.array() + kMargin).cast<std::size_t>();
    return p.x() + kSide * (p.y() + kSide * p.z());
  }
  /// Index distances of neighbours along each axis.
  static constexpr std::array<std::ptrdiff_t, 3> kSteps{1, kSide, std::ptrdiff_t{kSide} * kSide};

  [[nodiscard]] int distance(std::size_t i) const { return distances_[i]; }      ///< brick_layout.h
  [[nodiscard]] std::uint32_t label(std::size_t i) const { return labels_[i]; }  ///< label_voxel.h
  [[nodiscard]] std::uint32_t color(std::size_t i) const { return colors_[i]; }  ///< color_voxel.h
  [[nodiscard]] bool hasLabels() const { return has_labels_; }                   ///< any at all
  [[nodiscard]] bool hasColors() const { return has_colors_; }                   ///< any at all

 private:
  /// Copies the part of a brick inside the block. `first`: its first voxel, relative to the page's; `number`:
  /// index of the brick in `held`.
  void copyBrick(const BrickContents& held, std::size_t number, const Eigen::Vector3i& first);

  std::vector<cl_short> distances_;
  std::vector<std::uint32_t> labels_, colors_;
  std::bitset<PAGE_BRICKS> bricks_;
  Eigen::Vector3i first_voxel_ = Eigen::Vector3i::Zero();
  bool has_labels_ = false;
  bool has_colors_ = false;
};

}  // namespace scantrove
