#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/collection/candidate_crop.h"

namespace scantrove {

/// One frame and its pose, as far as cropping views needs them.
struct ObservedFrame {
  const RgbdFrame& frame;
  const Eigen::Isometry3d& T_world_camera;
  const SurfaceInColor& in_color;  ///< at the resolution of the candidates

  [[nodiscard]] bool hasColor() const { return !frame.color.empty(); }
  /// See cropView() of candidate_crop.h.
  [[nodiscard]] std::optional<ObjectView> cropView(const Candidate& candidate) const {
    return scantrove::cropView(frame, T_world_camera, in_color, candidate);
  }
  [[nodiscard]] Eigen::Vector3f directionOf(const Candidate& candidate) const {
    return scantrove::directionOf(candidate, T_world_camera);
  }
};

}  // namespace scantrove
