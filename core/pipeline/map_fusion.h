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

/// The dense map with what keeps moving things out of it, and its surface as the last usable frame sees it.
/// One thread, the context's; may throw cl::Error.
class MapFusion {
 public:
  /// All outlive this.
  [[nodiscard]] static Result<std::unique_ptr<MapFusion>> create(ComputeContext& compute, StageTimer& timer,
                                                                 const FusionParams& params);

  [[nodiscard]] DenseMap& map() { return *map_; }
  [[nodiscard]] BrickMap& bricks() { return map_->bricks(); }
  [[nodiscard]] const BrickMap& bricks() const { return map_->bricks(); }

  /// The frame goes into the map, but for what moves.
  void integrate(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera);
  /// Takes the surface from there, for a frame that was just integrated, without what moving things hide.
  void raycast(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// The surface as the map shows it from there, in place of a frame's.
  void raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K);
  /// V_t, N_t of the last usable frame.
  [[nodiscard]] const SurfaceMaps& surface() const { return surface_; }
  /// Of it, what the camera should be followed by; valid until the next call.
  [[nodiscard]] const SurfaceMaps& settledSurface() { return motion_->settled(surface_, bricks()); }
  /// `view`: of surface(). The next frame's moving things are told by it.
  void remember(const RenderedView& view) { known_ = KnownSurface(view); }
  /// `view`: of surface(); `hidden`: SurfaceInColor.
  void integrateColor(const RgbdFrame& frame, const RenderedView& view, const DepthPyramid& depth,
                      const cv::Mat& hidden);
  /// MergeInput::appeared of the frame that was integrated last; valid until the next one.
  [[nodiscard]] std::span<const std::uint8_t> newlyAppeared();
  /// Ends the frame: DenseMap::settle.
  void settle() { map_->settle(); }

  /// Its part of what a session keeps. There was a usable frame.
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
  KnownSurface known_;  // surface_, on the host
  cv::Mat appeared_;
};

}  // namespace scantrove
