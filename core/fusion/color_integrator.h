#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/rendered_view.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// Averages colour images into the voxels along the surface that a frame shows (BrickMap::colors): near and
/// straight views count for more (color_bricks.cl). Cost per frame is bounded: where the surface passes
/// through more than about kBricksAtATime bricks, they take turns. One thread, the context's.
class ColorIntegrator {
 public:
  static constexpr std::size_t kBricksAtATime = 512;  ///< bounds the cost of a frame

  [[nodiscard]] static Result<ColorIntegrator> create(ComputeContext& compute, const FusionParams& params);

  /// The frame's surface, after it went into the map, as its depth camera sees it.
  struct Surface {
    const SurfaceMaps& maps;       ///< V_t and N_t on the device
    const RenderedView& view;      ///< of the maps
    const DepthPyramid& readings;  ///< of the frame; its first level is of the same pixels as V_t
    const cv::Mat& hidden;         ///< CV_8UC1 of the same pixels, not 0 = not seen by the colour camera
  };

  /// Nothing happens where the frame has no colour.
  void integrate(BrickMap& map, const Surface& surface, const RgbdFrame& frame);

  /// Which bricks and pixels are next.
  struct Turns {
    std::uint32_t frame = 0;  ///< frames with colour so far
    std::uint32_t first = 0;  ///< turn of the bricks that the next frame begins with
  };
  [[nodiscard]] Turns turns() const { return turns_; }
  void restoreState(Turns turns) { turns_ = turns; }

 private:
  ColorIntegrator(ComputeContext& compute, const FusionParams& params)
      : compute_(&compute), params_(params) {}

  /// Bricks within a voxel of the surface whose turn it is, into host_bricks_, counted from `first`.
  void listBricks(const BrickMap& map, const RenderedView& view, const Eigen::Vector3i& first);
  void rate(const BrickMap& map, const Surface& surface, const Eigen::Isometry3d& T_world_color);
  template <class T>
  void fit(Buffer<T>& buffer, std::size_t size) {
    if (buffer.size() < size) buffer = Buffer<T>(compute_->context(), size + size / 2);
  }

  ComputeContext* compute_;
  FusionParams params_;
  Kernel rate_pixels_, color_bricks_;
  Buffer<cl_uchar> hidden_, image_;
  Buffer<cl_float> depths_;
  Buffer<cl_uint> ratings_;
  Buffer<cl_int4> bricks_;
  std::vector<cl_int4> host_bricks_;
  std::vector<std::uint32_t> listed_in_;  ///< by slot: number of the frame that listed it last
  Turns turns_;
};

}  // namespace scantrove
