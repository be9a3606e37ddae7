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

/// The dense map: a truncated signed distance field in sparse bricks (Curless and Levoy; thesis 2.2, 3.1).
/// The cost per frame depends on the view, not on the scanned volume. Bricks beyond the memory budget are in
/// a file until a view meets them (BrickMap). The context's thread.
class DenseMap {
 public:
  [[nodiscard]] static Result<std::unique_ptr<DenseMap>> create(ComputeContext& compute,
                                                                const FusionParams& params);

  /// Allocates bricks along the band around each depth reading, then averages the frame into the bricks in
  /// view.
  void integrate(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera);

  /// Deactivates the bricks that the last frame found empty, after waiting for its integration on the device.
  /// The next integrate() does this itself. Call it before storing the map.
  void settle();

  /// V_t and N_t from `T_world_camera` for camera `K`; creates or resizes the buffers of `surface` as needed.
  void raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K, SurfaceMaps& surface);

  [[nodiscard]] BrickMap& bricks() { return bricks_; }
  [[nodiscard]] const BrickMap& bricks() const { return bricks_; }

 private:
  DenseMap(ComputeContext& compute, const FusionParams& params, BrickAllocator allocator,
           Integrator integrator, Raycaster raycaster);

  /// Sets `pages_` and `window` for a view and loads its bricks to the device.
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
