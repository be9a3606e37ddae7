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

/// Keeps what moves out of the map (thesis ch. 6), and takes out of it what has gone. Readings where a moment
/// ago there was free space are left out until they have stayed for about a second; surface that is seen
/// through loses its weight. One thread, the context's.
class MotionFilter {
 public:
  [[nodiscard]] static Result<std::unique_ptr<MotionFilter>> create(ComputeContext& compute,
                                                                    const FusionParams& params);

  /// The frame, taken at `T_world_camera`, without the readings of things that move; shares the buffers that
  /// it does not change. Valid until the next call. `known`: the map as seen from the frame before.
  [[nodiscard]] const DepthPyramid& still(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera,
                                          const KnownSurface& known);

  /// For the frame of the last still(), after it went into the map that `surface` shows from its pose: takes
  /// the weight from what the frame sees through, and from `surface` what the moving things hide of it.
  void apply(const DepthPyramid& frame, BrickMap& bricks, SurfaceMaps& surface);

  /// `surface` as the camera should be followed by: without what has been seen for a few frames only, which
  /// may be somebody who has just come into view. All of it where most is new. Shares the vertices; valid
  /// until the next call.
  [[nodiscard]] const SurfaceMaps& settled(const SurfaceMaps& surface, const BrickMap& bricks);

  /// The views that it judges the next frame by.
  [[nodiscard]] FreeSpace& freeSpace() { return free_space_; }

  /// Where it remembers things to have come to rest.
  [[nodiscard]] AppearedObjects& appeared_objects() { return appeared_objects_; }

  /// Readings of the last frame by the thing that they came with, as AppearedObjects::atRest() has it; smaller than
  /// the frame.
  [[nodiscard]] const cv::Mat& appeared() const { return appeared_; }

  /// Pixels of the last frame that move: CV_8UC1, 255 or 0, smaller than the frame; empty when there are
  /// none.
  [[nodiscard]] const cv::Mat& moving() const { return moving_; }

 private:
  MotionFilter(ComputeContext& compute, const FusionParams& params)
      : compute_(compute), params_(params), free_space_(params.depth_noise_m) {}

  void doubt(const DepthPyramid& frame, BrickMap& bricks, const SurfaceMaps& surface);
  /// A mask on the device.
  [[nodiscard]] const Buffer<cl_uchar>& sent(const cv::Mat& mask);

  ComputeContext& compute_;
  FusionParams params_;
  FreeSpace free_space_;
  AppearedObjects appeared_objects_;
  Kernel leave_out_depth_, leave_out_surface_, leave_out_fresh_, mark_surface_;
  DepthPyramid still_;
  Buffer<cl_float> depth_m_;
  Buffer<cl_uchar> mask_;
  SurfaceMaps settled_;
  Buffer<cl_float4> settled_normals_;
  Buffer<cl_int> fresh_counts_;
  cv::Mat moving_, appeared_;
  cv::Mat vacated_;  // pixels in which the last frame saw through known surface, likewise
};

}  // namespace scantrove
