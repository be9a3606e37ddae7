#pragma once
#include <Eigen/Geometry>
#include <cstdint>

namespace scantrove {

/// The scenes that can be filmed, and how the hand that holds the camera moves.
enum class SceneKind {
  /// A table with 17 things, 0.8 - 1.1 m away; the camera walks around it (300 frames: nearly half the way).
  tabletop,
  /// A room with table, 17 things on it, chair, stool, basket, parcel, shelf; 400 frames. In the first views
  /// the chair cuts the floor in separate pieces; the camera then steps back and around it, and goes on to
  /// the table.
  room,
  /// An L-shaped block ("L block") in the middle of a table, with other things at a distance. In the first
  /// frames it is seen straight from the front: a foot and an upright that only meet in a concave edge. Later
  /// frames show the L-shaped side, which joins both over rounded convex edges. 150 frames.
  l_block,
  /// Floor, walls, a parcel, a basket, and a chair ("chair") that cuts the floor in the first frames; later
  /// frames show the floor around it in one piece. 150 frames.
  chair_floor,
};

namespace synthetic {

/// A handheld camera's way through a scene, for any time: smooth, at most about 0.35 m/s and 25 degrees/s.
class Trajectory {
 public:
  /// `seed` makes the tremor; without tremor the way is the same for every seed.
  Trajectory(SceneKind scene, bool tremor, std::uint32_t seed);
  /// T_world_camera: x right, y down, z forward.
  [[nodiscard]] Eigen::Isometry3d pose(double time_s) const;

 private:
  SceneKind scene_;
  bool tremor_;
  std::uint32_t seed_;
};

/// Length of the recording where none is asked for.
[[nodiscard]] int defaultFrameCount(SceneKind scene);

}  // namespace synthetic
}  // namespace scantrove
