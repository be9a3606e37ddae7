#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

namespace scantrove {

/// The plane on which an object stands, in the camera's frame, metres.
struct StandingPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, towards the camera
  double offset_m = 0;                                ///< normal . point of its points

  [[nodiscard]] double heightOf(const Eigen::Vector3d& point) const { return normal.dot(point) - offset_m; }
};

/// The plane near `seed` that carries what is there: it faces up in the image, holds many of the points
/// around the seed, and few points lie far below it. `points`: of one depth image, in the camera's frame.
/// None: no such plane, as around a thing held in a hand. Deterministic.
[[nodiscard]] std::optional<StandingPlane> findStandingPlane(std::span<const Eigen::Vector3d> points,
                                                             const Eigen::Vector3d& seed);

}  // namespace scantrove
