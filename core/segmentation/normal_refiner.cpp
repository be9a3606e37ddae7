#include "core/segmentation/normal_refiner.h"

#include "core/compute/kernel_types.h"
#include "core/geometry/camera_depth.h"
#include "core/segmentation/kernels/window_layout.h"
#include "embedded/segmentation_kernels.h"

namespace scantrove {

Result<NormalRefiner> NormalRefiner::create(ComputeContext& compute) {
  Result<Kernel> invert = compute.kernel(kernels::segmentation, "invert_depth");
  if (!invert) return fail(invert.error());
  Result<Kernel> fit = compute.kernel(kernels::segmentation, "fit_planes");
  if (!fit) return fail(fit.error());
  Result<Kernel> choose = compute.kernel(kernels::segmentation, "choose_normals");
  if (!choose) return fail(choose.error());
  return NormalRefiner(compute, std::move(*invert), std::move(*fit), std::move(*choose));
}

void NormalRefiner::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  const auto stride = static_cast<std::size_t>(WINDOW_STRIDE(width));
  const auto rows = static_cast<std::size_t>(height);
  inverse_depth_ = Buffer<cl_float>(compute_->context(), stride * (rows + 2 * WINDOW_RADIUS));
  inverse_depth_.fill(compute_->queue(), 0.0F);
  planes_ = Buffer<cl_float>(compute_->context(), 4 * stride * rows);
  concavity_ = Buffer<cl_float>(compute_->context(), stride * rows);
  normals_ = Buffer<cl_float4>(compute_->context(), static_cast<std::size_t>(width) * rows);
}

const Buffer<cl_float4>& NormalRefiner::refine(const SurfaceMaps& surface, const SegmentationParams& params) {
  const Intrinsics& K = surface.K;
  SCANTROVE_CHECK(K.pixels() > 0);
  resize(K.width, K.height);
  const Eigen::RowVector4f row = CameraDepth(surface.T_world_camera).row();
  const cl::NDRange pixels(static_cast<std::size_t>(K.width), static_cast<std::size_t>(K.height));
  invert_.launch(pixels, Lanes::pixelGroup(), surface.vertices_world, inverse_depth_, K.width, K.height,
                 toKernel(row[0], row[1], row[2], row[3]));
  const Lanes& lanes = compute_->lanes();
  fit_.launch(lanes.overRows(K.width, K.height), lanes.rowGroup(), inverse_depth_, planes_, concavity_,
              K.width, K.height, toKernel(K.fx, K.fy, K.cx, K.cy), params.normal_gate_m);
  choose_.launch(pixels, Lanes::pixelGroup(), inverse_depth_, planes_, concavity_, normals_, K.width,
                 K.height, toKernel(surface.T_world_camera), params.normal_gate_m, params.concave_from_m);
  return normals_;
}

}  // namespace scantrove
