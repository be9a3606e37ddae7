#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/appeared_objects.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/free_space.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/known_surface.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// Keeps moving objects out of the map (thesis ch. 6) and removes surface that has gone. Readings in recent
/// free space are left out until they have stayed for about a second. Surface with readings behind it loses
/// its weight. The context's thread.
class MotionFilter {
 public:
  [[nodiscard]] static Result<std::unique_ptr<MotionFilter>> create(ComputeContext& compute,
                                                                    const FusionParams& params);

  /// The frame, taken at `T_world_camera`, without the readings of moving objects; shares unchanged buffers.
  /// Valid until the next call. `known`: the map's surface rendered for the previous frame.
  [[nodiscard]] const DepthPyramid& still(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera,
                                          const KnownSurface& known);

  /// For the frame of the last still(), after integration; `surface` is the map rendered from its pose.
  /// Lowers the weight of surface with readings behind it. Removes from `surface` the part that moving
  /// objects hide.
  void apply(const DepthPyramid& frame, BrickMap& bricks, SurfaceMaps& surface);

  /// `surface` for tracking, without parts seen for only a few frames, which may be a person who just came
  /// into view. The complete surface if most of it is new. Shares the vertices; valid until the next call.
  [[nodiscard]] const SurfaceMaps& settled(const SurfaceMaps& surface, const BrickMap& bricks);

  /// The recent views against which the next frame is tested.
  [[nodiscard]] FreeSpace& freeSpace() { return free_space_; }

  /// The objects that came to rest.
  [[nodiscard]] AppearedObjects& appearedObjects() { return appeared_objects_; }

  /// AppearedObjects::atRest() of the last frame; smaller than the frame.
  [[nodiscard]] const cv::Mat& appeared() const { return appeared_; }

  /// Moving pixels of the last frame: CV_8UC1, 255 or 0, smaller than the frame; empty if none.
  [[nodiscard]] const cv::Mat& moving() const { return moving_; }

 private:
  MotionFilter(ComputeContext& compute, const FusionParams& params)
      : compute_(compute), params_(params), free_space_(params.depth_noise_m) {}

  void markMismatch(const DepthPyramid& frame, BrickMap& bricks, const SurfaceMaps& surface);
  /// Uploads a mask to the device.
  [[nodiscard]] const Buffer<cl_uchar>& sent(const cv::Mat& mask);

  ComputeContext& compute_;
  FusionParams params_;
  FreeSpace free_space_;
  AppearedObjects appeared_objects_;
  Kernel leave_out_depth_, leave_out_surface_, leave_out_fresh_, mark_mismatch_;
  DepthPyramid still_;
  Buffer<cl_float> depth_m_;
  Buffer<cl_uchar> mask_;
  SurfaceMaps settled_;
  Buffer<cl_float4> settled_normals_;
  Buffer<cl_int> fresh_counts_;
  cv::Mat moving_, appeared_;
  cv::Mat vacated_;  // pixels of the last frame with readings behind known surface, likewise
};

}  // namespace scantrove
