#pragma once
#include <Eigen/Core>
#include <span>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// Which way is up in the world's frame, a unit vector. Cameras are held upright, on either side or upside
/// down: each of the four says about where up is, and the largest surface that could be level then (a floor,
/// a table) says where exactly. That one of the four is taken for which most speaks: area that faces up, less
/// what faces down; a camera that looks down on it; the same roll in all frames; and half as much again for
/// the upright camera, as most are. Without such a surface: as the upright camera has it. Without key frames:
/// +z.
[[nodiscard]] Eigen::Vector3f upDirection(std::span<const KeyFrameInfo> frames, const LabeledMesh& mesh);

/// Turns `from` (a unit vector) to `to`, by the smallest angle.
[[nodiscard]] Eigen::Affine3f turning(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

}  // namespace scantrove
