#include "core/fusion/depth_preprocessor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/check.h"
#include "core/capture/usable_depth.h"
#include "core/compute/kernel_types.h"
#include "core/fusion/image_limits.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

constexpr int kLevels = 3;              ///< half the size each: ICP starts with a quarter of the width
constexpr int kSmallestLevel_px = 16;   ///< no level narrower or lower than this, besides the first
constexpr float kRangeBase_m = 0.008F;  ///< reach of the filter over depth, at depth 0 ...
constexpr float kRangeInNoise =
    16.0F / 3;  ///< ... and its growth with z^2, in standard deviations of the depth

/// Every pixel covers exactly 2 x 2 pixels; an odd last row or column is left out.
Intrinsics halved(const Intrinsics& K) {
  return {K.fx / 2, K.fy / 2, (K.cx + 0.5F) / 2 - 0.5F, (K.cy + 0.5F) / 2 - 0.5F, K.width / 2, K.height / 2};
}

cl::NDRange imageRange(int width, int height) {
  return {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
}

}  // namespace

Intrinsics workingCameraOf(const Intrinsics& K, int working_width) {
  if (K.width <= working_width) return K;
  const double height = static_cast<double>(K.height) * working_width / K.width;
  return K.resizedTo(working_width, std::max(1, static_cast<int>(std::lround(height))));
}

Result<std::unique_ptr<DepthPreprocessor>> DepthPreprocessor::create(ComputeContext& compute,
                                                                     const Intrinsics& K,
                                                                     const FusionParams& params) {
  if (K.width < 1 || K.height < 1 || params.working_width < 1) {
    return fail("Images of " + std::to_string(K.width) + " x " + std::to_string(K.height) +
                    " pixels cannot be scanned at a working width of " +
                    std::to_string(params.working_width) + ".",
                "Give the size of the depth images and a working width of at least 1.");
  }
  if (K.width < kMinWidth_px) {
    return fail("Images of " + std::to_string(K.width) + " x " + std::to_string(K.height) +
                    " pixels are too narrow to be scanned.",
                "Give depth images that are at least " + std::to_string(kMinWidth_px) + " pixels wide.");
  }
  try {
    std::unique_ptr<DepthPreprocessor> preprocessor(new DepthPreprocessor(compute, K, params));
    SCANTROVE_TRY(preprocessor->buildKernels());
    return preprocessor;
  } catch (const cl::Error& error) {
    return fail("The depth buffers do not fit on " + compute.deviceName() + " (" + error.what() + ", code " +
                    std::to_string(error.err()) + ").",
                "Close other programs that use the device, or choose another with --device.");
  }
}

DepthPreprocessor::DepthPreprocessor(ComputeContext& compute, const Intrinsics& K, const FusionParams& params)
    : compute_(compute), K_recording_(K), params_(params) {
  pyramid_.K = K;
  const auto pixels = static_cast<std::size_t>(K.pixels());
  units_ = Buffer<cl_ushort>(compute.context(), pixels);
  pyramid_.depth_m = Buffer<cl_float>(compute.context(), pixels);

  Intrinsics level_K = workingCameraOf(K, params.working_width);
  ratio_x_ = static_cast<float>(K.width) / static_cast<float>(level_K.width);
  ratio_y_ = static_cast<float>(K.height) / static_cast<float>(level_K.height);
  reduced_ = DepthPlane(compute, level_K.width, level_K.height);
  for (int level = 0; level < kLevels; ++level) {
    if (level > 0) level_K = halved(level_K);
    if (level > 0 && std::min(level_K.width, level_K.height) < kSmallestLevel_px) break;
    planes_.emplace_back(compute, level_K.width, level_K.height);
    const auto level_pixels = static_cast<std::size_t>(level_K.pixels());
    pyramid_.levels.push_back({level_K, Buffer<cl_float4>(compute.context(), level_pixels),
                               Buffer<cl_float4>(compute.context(), level_pixels)});
  }
}

Result<void> DepthPreprocessor::buildKernels() {
  SCANTROVE_TRY(moveInto(convert_, compute_.kernel(kernels::fusion, "convert_depth")));
  if (!halves()) {
    SCANTROVE_TRY(moveInto(reduce_, compute_.kernel(kernels::reduce_depth, "reduce_depth")));
  }
  SCANTROVE_TRY(moveInto(halve_, compute_.kernel(kernels::fusion, "halve_depth")));
  SCANTROVE_TRY(moveInto(filter_, compute_.kernel(kernels::fusion, "filter_depth")));
  return moveInto(build_surface_, compute_.kernel(kernels::fusion, "build_surface"));
}

const DepthPyramid& DepthPreprocessor::process(const RgbdFrame& frame) {
  setCamera(frame.intrinsics.value_or(K_recording_));
  upload(frame);
  reduceAndFilter();
  for (std::size_t level = 0; level < planes_.size(); ++level) {
    if (level > 0) halve(planes_[level - 1].meters, planes_[level - 1].stride, PLANE_PAD, planes_[level]);
    buildSurface(planes_[level], pyramid_.levels[level]);
  }
  return pyramid_;
}

void DepthPreprocessor::setCamera(const Intrinsics& K) {
  SCANTROVE_CHECK(K.width == K_recording_.width && K.height == K_recording_.height);
  pyramid_.K = K;
  Intrinsics level_K = workingCameraOf(K, params_.working_width);
  for (DepthPyramid::Level& level : pyramid_.levels) {
    level.K = level_K;
    level_K = halved(level_K);
  }
}

void DepthPreprocessor::upload(const RgbdFrame& frame) {
  const Intrinsics& K = pyramid_.K;
  SCANTROVE_CHECK(frame.depth.type() == CV_16UC1 && frame.depth.cols == K.width &&
                  frame.depth.rows == K.height);
  const cv::Mat usable = usableDepth(frame);
  const cv::Mat depth = usable.isContinuous() ? usable : usable.clone();
  units_.write(compute_.queue(), {depth.ptr<cl_ushort>(), units_.size()});
  convert_.launch(cl::NDRange(units_.size()), cl::NullRange, units_, cl_int{K.pixels()},
                  cl_float{frame.meters_per_unit}, cl_float{params_.min_depth_m},
                  cl_float{params_.max_depth_m}, pyramid_.depth_m);
}

void DepthPreprocessor::reduceAndFilter() {
  if (halves()) {
    halve(pyramid_.depth_m, pyramid_.K.width, 0, reduced_);
  } else {
    reduce();
  }
  const Lanes& lanes = compute_.lanes();
  filter_.launch(lanes.overRows(reduced_.width, reduced_.height), lanes.rowGroup(), reduced_.meters,
                 cl_int{reduced_.width}, cl_int{reduced_.height}, cl_int{reduced_.stride},
                 cl_float{kRangeBase_m}, cl_float{kRangeInNoise * params_.depth_noise_m},
                 planes_.front().meters);
}

void DepthPreprocessor::reduce() {
  const Intrinsics& K = pyramid_.K;
  reduce_.launch(imageRange(reduced_.width, reduced_.height), cl::NullRange, pyramid_.depth_m,
                 cl_int{K.width}, cl_int{K.height}, cl_int{reduced_.width}, cl_int{reduced_.height},
                 cl_int{reduced_.stride}, reduced_.meters);
}

void DepthPreprocessor::halve(const Buffer<cl_float>& large, int large_stride, int large_pad,
                              DepthPlane& small) {
  const Lanes& lanes = compute_.lanes();
  halve_.launch(lanes.overEights(small.width, small.height), lanes.rowGroup(), large, cl_int{large_stride},
                cl_int{large_pad}, cl_int{small.width}, cl_int{small.height}, cl_int{small.stride},
                small.meters);
}

void DepthPreprocessor::buildSurface(const DepthPlane& plane, DepthPyramid::Level& level) {
  const Lanes& lanes = compute_.lanes();
  build_surface_.launch(lanes.overRows(plane.width, plane.height), lanes.rowGroup(), plane.meters,
                        cl_int{plane.width}, cl_int{plane.height}, cl_int{plane.stride},
                        toKernel(level.K.fx, level.K.fy, level.K.cx, level.K.cy), level.vertices_camera,
                        level.normals_camera);
}

}  // namespace scantrove
