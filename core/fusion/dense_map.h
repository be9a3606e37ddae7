#pragma once
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_allocator.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/brick_window.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/integrator.h"
#include "core/fusion/raycaster.h"
#include "core/fusion/surface_maps.h"
#include "core/fusion/view_frustum.h"

namespace scantrove {

/// The dense map: a truncated signed distance in sparse bricks (Curless and Levoy; thesis 2.2, 3.1). Cost per
/// frame follows the view, never what was scanned. What has no room in the memory budget waits in a file
/// until a view meets it (BrickMap). One thread, the context's.
class DenseMap {
 public:
  [[nodiscard]] static Result<std::unique_ptr<DenseMap>> create(ComputeContext& compute,
                                                                const FusionParams& params);

  /// Allocates bricks along the band around each depth reading, then averages the frame into the bricks in
  /// view.
  void integrate(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera);

  /// Lays aside the bricks that the last frame found empty. Waits until the device has integrated it; the
  /// next integrate() does this by itself. A map that is kept after this is the one that the next frame
  /// meets.
  void settle();

  /// V_t and N_t from `T_world_camera` for camera `K`; buffers of `surface` are made or resized as needed.
  void raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K, SurfaceMaps& surface);

  [[nodiscard]] BrickMap& bricks() { return bricks_; }
  [[nodiscard]] const BrickMap& bricks() const { return bricks_; }

 private:
  DenseMap(ComputeContext& compute, const FusionParams& params, BrickAllocator allocator,
           Integrator integrator, Raycaster raycaster);

  /// Makes `pages_` and `window` those of a view, and its bricks those on the device.
  void beginFrame(const ViewFrustum& frustum, BrickWindow& window);

  ComputeContext& compute_;
  FusionParams params_;
  BrickMap bricks_;
  BrickAllocator allocator_;
  Integrator integrator_;
  Raycaster raycaster_;
  std::vector<int> pages_;
  BrickWindow window_;
};

}  // namespace scantrove
