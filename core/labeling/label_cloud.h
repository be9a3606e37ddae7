#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/surface_maps.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/point_extractor.h"

namespace scantrove {

/// The label cloud (thesis 3.3.3): the fragment of every voxel, stored in the brick map (BrickPools::labels),
/// and the number of voxels of each fragment, on the device or in the file. Most of its more than twenty
/// fields are buffers that stay allocated between frames. The context's thread.
class LabelCloud {
 public:
  [[nodiscard]] static Result<std::unique_ptr<LabelCloud>> create(ComputeContext& compute);

  /// S_prj,t: the fragment at each vertex of `surface`, row by row. The next update() of the same view uses
  /// its confidences.
  [[nodiscard]] std::vector<FragmentId> project(const SurfaceMaps& surface, const BrickMap& bricks);

  /// Writes S_cloud,t into exactly the voxels that Algorithm 1 would write, visiting only those in view.
  /// `merged`: the fragment of each pixel of `surface`. With `params.voxel_confidence` a voxel changes its
  /// fragment only after as many frames as its confidence. It changes to fragments in `split_off` at once.
  /// Pixels that only confirm voxels of full confidence (project()) are written every fourth time. Voxels of
  /// missing bricks are left out. Returns the bricks that were written to.
  std::span<const Eigen::Vector3i> update(const SurfaceMaps& surface, std::span<const FragmentId> merged,
                                          std::span<const FragmentId> split_off, const LabelingParams& params,
                                          const BrickMap& map);

  /// Sets these voxels (brick_layout.h, each once) to `fragment`, except unlabelled ones. Bricks in the map's
  /// file are loaded.
  void relabel(std::span<const Eigen::Vector3i> voxels, FragmentId fragment, BrickMap& map);
  /// The counts of a map that was loaded.
  void restoreVoxelCounts(std::vector<cl_int> voxels);
  /// The number of frames that wrote to that map: they decide which pixels have their turn next.
  void restoreTurn(std::size_t frames) { turn_ = frames; }

  /// Voxels of each fragment, by fragment number; may end before the highest number if the rest have none.
  [[nodiscard]] const std::vector<cl_int>& voxelsOfFragments() const { return fragment_voxels_host_; }

  using Extract = PointExtractor::Extract;
  /// PointExtractor::extract().
  [[nodiscard]] Extract extract(std::span<const Eigen::Vector3i> bricks, BrickMap& map,
                                float truncation_vox) {
    return extractor_.extract(bricks, map, truncation_vox);
  }

 private:
  LabelCloud(ComputeContext& compute, PointExtractor extractor);
  [[nodiscard]] Result<void> buildKernels();

  /// Makes room for counts of fragments up to `highest`.
  void fitFragments(std::uint32_t highest);
  /// Writes new_labels_ to the voxels at the vertices of pixels_.
  void writeLabels(const SurfaceMaps& surface, const LabelingParams& params, const BrickMap& map);
  /// Fills pixels_ and new_labels_.
  void listPixels(std::span<const FragmentId> merged, std::span<const FragmentId> split_off, bool all);
  void fitStamps(const BrickMap& map);

  ComputeContext& compute_;
  PointExtractor extractor_;
  Kernel project_labels_, update_labels_, relabel_voxels_;
  Buffer<cl_int> stamps_, touched_, touched_count_;
  Buffer<cl_int4> listed_;
  Buffer<cl_uint> projected_, new_labels_;
  Buffer<cl_int> pixels_;
  Buffer<cl_int> fragment_voxels_;
  std::vector<cl_int> touched_slots_, fragment_voxels_host_;
  std::vector<Eigen::Vector3i> touched_bricks_;
  std::vector<cl_uint> projected_host_, new_labels_host_;
  std::vector<cl_int> pixels_host_;
  cl_int stamp_ = 0;
  std::size_t turn_ = 0;                             ///< updates of projected views
  std::optional<Eigen::Isometry3d> projected_view_;  ///< T_world_camera of projected_host_
};

}  // namespace scantrove
