#pragma once
#include <Eigen/Geometry>

#include "core/capture/intrinsics.h"
#include "core/compute/buffer.h"
#include "core/fusion/brick_window.h"

namespace scantrove {

/// V_t and N_t: the map's surface rendered from one pose, on the device, `K.width * K.height` elements row by
/// row.
struct SurfaceMaps {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Buffer<cl_float4> vertices_world;  ///< (x, y, z, 1) metres in the world; all 0 without surface
  Buffer<cl_float4> normals_world;   ///< (x, y, z, 1) unit, towards the camera; all 0 without normal
  BrickWindow window = {};           ///< the bricks in view, valid until the map changes
};

}  // namespace scantrove
