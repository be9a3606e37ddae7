#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/base/stage_timer.h"
#include "core/compute/compute_context.h"
#include "core/fusion/color_integrator.h"
#include "core/fusion/dense_map.h"
#include "core/fusion/motion_filter.h"
#include "core/fusion/rendered_view.h"
#include "core/pipeline/camera_memory.h"

namespace scantrove {

/// The dense map without moving things, and its surface from the last usable frame. One thread, the
/// context's; may throw cl::Error.
class MapFusion {
 public:
  /// All outlive this.
  [[nodiscard]] static Result<std::unique_ptr<MapFusion>> create(ComputeContext& compute, StageTimer& timer,
                                                                 const FusionParams& params);

  [[nodiscard]] DenseMap& map() { return *map_; }
  [[nodiscard]] BrickMap& bricks() { return map_->bricks(); }
  [[nodiscard]] const BrickMap& bricks() const { return map_->bricks(); }

  /// Integrates the frame without moving things.
  void integrate(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera);
  /// Renders the surface from the pose of the frame just integrated, without surface that moving things
  /// hide.
  void raycast(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// Renders the map's surface from there, in place of a frame's.
  void raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// V_t, N_t of the last usable frame.
  [[nodiscard]] const SurfaceMaps& surface() const { return surface_; }
  /// The part of the surface for tracking the camera; valid until the next call.
  [[nodiscard]] const SurfaceMaps& settledSurface() { return motion_->settled(surface_, bricks()); }
  /// `view`: of surface(). It detects moving things in the next frame.
  void remember(const RenderedView& view) { known_ = KnownSurface(view); }
  /// `view`: of surface(); `hidden`: SurfaceInColor.
  void integrateColor(const RgbdFrame& frame, const RenderedView& view, const DepthPyramid& depth,
                      const cv::Mat& hidden);
  /// MergeInput::appeared of the last integrated frame; valid until the next one.
  [[nodiscard]] std::span<const std::uint8_t> newlyAppeared();
  /// Ends the frame: DenseMap::settle.
  void settle() { map_->settle(); }

  /// Its part of the session's memory. Requires a usable frame.
  void save(CameraMemory& memory);
  void restore(CameraMemory& memory);

 private:
  MapFusion(ComputeContext& compute, StageTimer& timer) : compute_(compute), timer_(timer) {}

  ComputeContext& compute_;
  StageTimer& timer_;
  std::unique_ptr<MotionFilter> motion_;
  std::unique_ptr<DenseMap> map_;
  std::optional<ColorIntegrator> color_;
  SurfaceMaps surface_;
  KnownSurface known_;  // surface_ on the host
  cv::Mat appeared_;
};

}  // namespace scantrove
