#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/labeling/kernels/label_voxel.h"

namespace scantrove {

/// Extracts labelled points from a map's bricks, on the device or in the file. The context's thread.
class PointExtractor {
 public:
  [[nodiscard]] static Result<PointExtractor> create(ComputeContext& compute);

  /// Labelled voxels within one voxel of the surface, with colour, normal and distance from the surface.
  struct Extract {
    std::vector<LabelPoint> points;    ///< of all bricks, brick after brick
    std::vector<std::uint32_t> first;  ///< bricks.size() + 1: bricks[i] has [first[i], first[i + 1])
  };
  /// Bricks in the map's file are read and stay there. Listing the bricks of one page together reads it once.
  [[nodiscard]] Extract extract(std::span<const Eigen::Vector3i> bricks, BrickMap& map, float truncation_vox);

 private:
  explicit PointExtractor(ComputeContext& compute) : compute_(&compute) {}
  /// Appends to `extract` the points of the bricks x, y, z, slot (of these pools), brick after brick.
  void extractListed(std::span<const cl_int4> listed, const Buffer<cl_short>& distances,
                     const Buffer<cl_uint>& labels, const Buffer<cl_uint>& colors, float voxel_size_m,
                     float truncation_vox, Extract& extract);

  ComputeContext* compute_;
  Kernel extract_points_;
  Buffer<cl_int4> listed_;
  Buffer<cl_int> offsets_;
  Buffer<LabelPoint> points_;
  Buffer<cl_short> stored_distances_;
  Buffer<cl_uint> stored_labels_, stored_colors_;
};

}  // namespace scantrove
