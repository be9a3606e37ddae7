#pragma once
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/compute/buffer.h"

namespace scantrove {

/// One depth frame prepared on the device.
struct DepthPyramid {
  Intrinsics K;              ///< of the full-resolution image of this frame
  Buffer<cl_float> depth_m;  ///< full resolution, unfiltered metres, 0 = none; for integration

  struct Level {
    Intrinsics K;
    Buffer<cl_float4> vertices_camera;  ///< filtered; (x, y, z, 1) metres, all 0 = none
    Buffer<cl_float4> normals_camera;   ///< (x, y, z, 1) unit, towards the camera, all 0 = none
  };
  std::vector<Level> levels;  ///< [0] has the working resolution, each next one half of the previous
};

}  // namespace scantrove
