#pragma once
#include <Eigen/Core>
#include <span>

#include "core/dataset/labelled_scan.h"

namespace scantrove {

/// Which way is up in the world's frame, a unit vector: as a person holds a camera, on the whole, and then
/// square to the largest surface that is about level (a floor, a table). Without key frames: +z.
[[nodiscard]] Eigen::Vector3f upDirection(std::span<const KeyFrameInfo> frames, const LabelledMesh& mesh);

/// Turns `from` (a unit vector) to `to`, by the smallest angle.
[[nodiscard]] Eigen::Affine3f turning(const Eigen::Vector3f& from, const Eigen::Vector3f& to);

}  // namespace scantrove
