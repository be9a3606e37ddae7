#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace scantrove {

// The map's surface across an outline: from a pixel of a rendered view to a pixel beyond it.

/// Pixels at an edge may lie between two surfaces: a step ends past the first pixel beyond the outline.
inline constexpr int kBeyondEdge_px = 2;
/// Normals and segments are compared this many pixels to either side; nearer voxels mix both sides.
inline constexpr int kBendReach_px = 3;
/// A surface that turns by more has an edge there: 20 degrees, well above the noise of normals.
inline constexpr float kClearBend_rad = 0.35F;

/// Surfaces whose depths differ by more do not touch: one occludes the other. Lower things (a plate, the edge
/// of a rug) occlude no floor, and depth edges blur by as much.
inline constexpr float kOcclusionStep_m = 0.03F;
/// Beyond this depth the step grows in proportion to depth, as pixels do.
inline constexpr float kOcclusionStepGrowsFrom_m = 1.5F;

/// d_max of thesis eq. 3.5: neighbouring pixels whose points are farther apart belong to surfaces that do not
/// touch. Metres, for a depth of `z_m`.
[[nodiscard]] inline float maxNeighborDistance(float z_m, float focal_px) {
  constexpr float kFactor = 3, kMin_m = 0.01F;
  return std::max(kFactor * z_m / focal_px, kMin_m);
}

enum class DepthStep { nearer, level, deeper };

/// Compares the depth beyond a step, `z_beyond`, with that before it, `z`; metres.
[[nodiscard]] inline DepthStep depthStep(float z, float z_beyond) {
  const float step_m = kOcclusionStep_m * std::max(1.0F, z / kOcclusionStepGrowsFrom_m);
  if (z_beyond < z - step_m) return DepthStep::nearer;
  return z_beyond > z + step_m ? DepthStep::deeper : DepthStep::level;
}

/// Angle between the unit normals `n_a` and `n_b` of two points, `across` from a to b: > 0 where the surface
/// folds inwards, < 0 over a ridge. Radians.
[[nodiscard]] inline float bendBetween(const Eigen::Vector4f& n_a, const Eigen::Vector4f& n_b,
                                       const Eigen::Vector3f& across) {
  const Eigen::Vector3f turn = (n_b - n_a).head<3>();
  const float angle = 2 * std::asin(std::min(1.0F, turn.norm() / 2));
  return across.dot(turn) > 0 ? -angle : angle;
}

}  // namespace scantrove
