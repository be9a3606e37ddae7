#pragma once
#include <Eigen/Geometry>

#include "core/compute/opencl.h"

namespace scantrove {

/// The row-major 4x4 matrix that kernels receive as float16 (see common.clh).
[[nodiscard]] inline cl_float16 toKernel(const Eigen::Isometry3d& T) {
  cl_float16 result;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      result.s[4 * row + column] = static_cast<float>(T.matrix()(row, column));
  }
  return result;
}

[[nodiscard]] inline cl_float4 toKernel(float x, float y, float z, float w) { return {{x, y, z, w}}; }

}  // namespace scantrove
