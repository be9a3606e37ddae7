#pragma once
#include "core/editing/editable_map.h"
#include "core/fusion/brick_map.h"
#include "core/labeling/label_cloud.h"

namespace scantrove {

/// The label cloud for operations. One thread, the context's; may throw cl::Error.
class EditableCloud final : public EditableMap {
 public:
  EditableCloud(LabelCloud& cloud, BrickMap& bricks, float truncation_vox)
      : cloud_(cloud), bricks_(bricks), truncation_vox_(truncation_vox) {}

  [[nodiscard]] float voxelSize() const override { return bricks_.voxelSize(); }
  [[nodiscard]] std::span<const int> voxelsOfFragments() const override { return cloud_.voxelsOfFragments(); }
  [[nodiscard]] std::vector<SurfaceVoxel> surfaceOf(std::span<const FragmentId> fragments,
                                                    std::span<const Eigen::Vector3f> places) override;
  void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment) override;

  /// Bricks that relabel() changed since the last call.
  [[nodiscard]] std::vector<Eigen::Vector3i> takeChanged() { return std::exchange(changed_, {}); }

 private:
  /// Appends the voxels of the fragments in the bricks; tells for each brick whether there were any.
  std::vector<bool> collect(std::span<const Eigen::Vector3i> bricks, std::span<const FragmentId> fragments,
                            std::vector<SurfaceVoxel>& voxels);

  LabelCloud& cloud_;
  BrickMap& bricks_;
  float truncation_vox_;
  std::vector<Eigen::Vector3i> changed_;
};

}  // namespace scantrove
