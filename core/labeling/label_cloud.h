#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/surface_maps.h"
#include "core/labeling/kernels/label_voxel.h"
#include "core/labeling/labeling_params.h"
#include "core/labeling/region_map.h"

namespace scantrove {

/// The label cloud (thesis 3.3.3): a fragment in every voxel of the brick map's bricks, on the device, and
/// how many voxels hold each. One thread, the context's.
class LabelCloud {
 public:
  [[nodiscard]] static Result<std::unique_ptr<LabelCloud>> create(ComputeContext& compute);

  /// S_prj,t: the fragment at each vertex of `surface`, row by row.
  [[nodiscard]] std::vector<FragmentId> project(const SurfaceMaps& surface, const BrickMap& bricks);

  /// Writes S_cloud,t into every voxel that Algorithm 1 would write over all of space, and into no other.
  /// With `params.voxel_confidence` a voxel that holds another fragment gives way only after as many frames
  /// as it was sure of; to the fragments `carved` it gives way at once. Allocates bricks where such a voxel
  /// has none. Returns the slots of the bricks that were written to.
  std::span<const cl_int> update(const SurfaceMaps& surface, const RegionMap& merged,
                                 std::span<const FragmentId> carved, const LabelingParams& params,
                                 BrickMap& bricks);

  /// How many voxels hold each fragment, by fragment number; shorter than the highest number where none does.
  [[nodiscard]] const std::vector<cl_int>& voxelsOfFragments() const { return fragment_voxels_host_; }

  /// Labelled voxels within a voxel of the surface, for some bricks.
  struct Extract {
    std::vector<LabelPoint> points;    ///< of all bricks, brick after brick
    std::vector<std::uint32_t> first;  ///< slots.size() + 1: points of slots[i] are [first[i], first[i + 1])
  };
  [[nodiscard]] Extract extract(std::span<const cl_int> slots, const BrickMap& bricks, float truncation_vox);

  /// slotCapacity * 512 label voxels (label_voxel.h), for tests.
  [[nodiscard]] const Buffer<cl_uint>& voxels() const { return labels_; }
  [[nodiscard]] std::size_t deviceBytes() const { return labels_.size() * sizeof(cl_uint); }

 private:
  explicit LabelCloud(ComputeContext& compute);
  [[nodiscard]] Result<void> buildKernels();

  /// Room to count the voxels of fragments up to `highest`.
  void fitFragments(std::uint32_t highest);
  /// Gives every slot of `bricks` its labels (0 when new), stamp and position.
  void fitPools(const BrickMap& bricks);
  /// Allocates every brick that a voxel within `reach` of a vertex lies in.
  void makeMissingBricks(const SurfaceMaps& surface, float reach, BrickMap& bricks);
  template <class T>
  void fit(Buffer<T>& buffer, std::size_t size) {
    if (buffer.size() < size) buffer = Buffer<T>(compute_.context(), size + size / 2);
  }

  ComputeContext& compute_;
  Kernel project_labels_, list_uncovered_bricks_, update_labels_, extract_points_;
  Buffer<cl_uint> labels_;
  Buffer<cl_int> stamps_, touched_, count_, listed_, offsets_;
  Buffer<cl_int4> positions_, missing_;
  Buffer<cl_uint> projected_, new_labels_;
  Buffer<cl_int> fragment_voxels_;
  Buffer<LabelPoint> points_;
  std::vector<cl_int> touched_host_, fragment_voxels_host_;
  std::vector<cl_uint> new_labels_host_;
  cl_int stamp_ = 0;
  int positions_known_ = 0;
};

}  // namespace scantrove
