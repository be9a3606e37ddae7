#pragma once
#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"
#include "core/fusion/kernels/depth_plane.h"

namespace scantrove {

/// Depth in metres on the device, padded with zeros (depth_plane.clh).
struct DepthPlane {
  int width = 0;
  int height = 0;
  int stride = 0;
  Buffer<cl_float> meters;

  DepthPlane() = default;
  DepthPlane(ComputeContext& compute, int width_px, int height_px)
      : width(width_px),
        height(height_px),
        stride((width_px + PLANE_RUN - 1) / PLANE_RUN * PLANE_RUN + 2 * PLANE_PAD),
        meters(compute.context(),
               static_cast<std::size_t>(stride) * static_cast<std::size_t>(height + 2 * PLANE_PAD)) {
    meters.fill(compute.queue(), 0.0F);
  }
};

}  // namespace scantrove
