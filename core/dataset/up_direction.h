#pragma once
#include <Eigen/Core>
#include <span>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// The up direction in the world frame, a unit vector. Cameras are held upright, on either side or upside
/// down. Each of the four implies an approximate up direction, and the largest surface that may be level (a
/// floor, a table) gives the exact one. The best supported of the four is chosen: by area that faces up,
/// less area that faces down; a camera that looks down on it; the same roll in all frames; and half as much
/// again for the upright camera, the most common. Without such a surface: the approximate direction of the
/// upright camera. Without key frames: +z.
[[nodiscard]] Eigen::Vector3f upDirection(std::span<const KeyFrameInfo> frames, const LabeledMesh& mesh);

/// Rotates `from` (a unit vector) to `to`, by the smallest angle.
[[nodiscard]] Eigen::Affine3f turning(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

}  // namespace scantrove
