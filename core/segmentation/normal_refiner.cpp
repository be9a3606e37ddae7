#include "core/segmentation/normal_refiner.h"

#include "core/compute/kernel_types.h"
#include "embedded/segmentation_kernels.h"

namespace scantrove {

Result<NormalRefiner> NormalRefiner::create(ComputeContext& compute) {
  const std::string options = "-DRADIUS=" + std::to_string(kRadius_px);
  Result<Kernel> invert = compute.kernel(kernels::refine_normals, "invert_depth", options);
  if (!invert) return fail(invert.error());
  Result<Kernel> fit = compute.kernel(kernels::refine_normals, "fit_planes", options);
  if (!fit) return fail(fit.error());
  Result<Kernel> choose = compute.kernel(kernels::refine_normals, "choose_normals", options);
  if (!choose) return fail(choose.error());
  return NormalRefiner(compute, std::move(*invert), std::move(*fit), std::move(*choose));
}

void NormalRefiner::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto padded =
      static_cast<std::size_t>(width + 2 * kRadius_px) * static_cast<std::size_t>(height + 2 * kRadius_px);
  inverse_depth_ = Buffer<cl_float>(compute_->context(), padded);
  inverse_depth_.fill(compute_->queue(), 0.0F);
  planes_ = Buffer<cl_float4>(compute_->context(), pixels);
  concavity_ = Buffer<cl_float>(compute_->context(), pixels);
  normals_ = Buffer<cl_float4>(compute_->context(), pixels);
}

const Buffer<cl_float4>& NormalRefiner::refine(const SurfaceMaps& surface, const SegmentationParams& params) {
  const Intrinsics& K = surface.K;
  SCANTROVE_CHECK(K.pixels() > 0);
  resize(K.width, K.height);
  const Eigen::Matrix4d T_camera_world = surface.T_world_camera.inverse().matrix();
  const Eigen::RowVector4f row = T_camera_world.row(2).cast<float>();
  const cl::NDRange pixels(static_cast<std::size_t>(K.width), static_cast<std::size_t>(K.height));
  invert_.launch(pixels, cl::NullRange, surface.vertices_world, inverse_depth_, K.width, K.height,
                 toKernel(row[0], row[1], row[2], row[3]));
  fit_.launch(pixels, cl::NullRange, inverse_depth_, planes_, concavity_, K.width, K.height,
              toKernel(K.fx, K.fy, K.cx, K.cy), params.normal_gate_m);
  choose_.launch(pixels, cl::NullRange, inverse_depth_, planes_, concavity_, normals_, K.width, K.height,
                 toKernel(surface.T_world_camera), params.normal_gate_m, params.concave_from_m);
  return normals_;
}

}  // namespace scantrove
