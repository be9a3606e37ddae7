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

/// Averages colour images into the voxels along a frame's surface (BrickPools::colors). Near and frontal
/// views weigh more (color_bricks.cl). Each frame updates about kBricksAtATime bricks at most, in turns,
/// which bounds its cost. The context's thread.
class ColorIntegrator {
 public:
  static constexpr std::size_t kBricksAtATime = 512;  ///< bounds the cost of a frame

  [[nodiscard]] static Result<ColorIntegrator> create(ComputeContext& compute, const FusionParams& params);

  /// The frame's surface after integration, as its depth camera sees it.
  struct Surface {
    const SurfaceMaps& maps;       ///< V_t and N_t on the device
    const RenderedView& view;      ///< of the maps
    const DepthPyramid& readings;  ///< of the frame; its first level has the pixels of V_t
    const cv::Mat& hidden;         ///< CV_8UC1, same pixels, not 0 = hidden from the colour camera
  };

  /// Does nothing if the frame has no colour.
  void integrate(BrickMap& map, const Surface& surface, const RgbdFrame& frame);

  /// The next bricks and pixels in turn.
  struct Turns {
    std::uint32_t frame = 0;  ///< frames with colour so far
    std::uint32_t first = 0;  ///< turn of the first bricks of the next frame
  };
  [[nodiscard]] Turns turns() const { return turns_; }
  void restoreState(Turns turns) { turns_ = turns; }

 private:
  ColorIntegrator(ComputeContext& compute, const FusionParams& params)
      : compute_(&compute), params_(params) {}

  /// Lists the bricks within a voxel of the surface whose turn it is into host_bricks_, relative to `first`.
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
  std::vector<std::uint32_t> listed_in_;  ///< by slot: last frame that listed it
  Turns turns_;
};

}  // namespace scantrove
