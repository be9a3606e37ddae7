#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/synthetic/scene.h"
#include "core/synthetic/trajectory.h"

namespace scantrove::synthetic {

/// Parts of a scene that do not stay where they were put.
struct AnimatedPart {
  std::size_t first_part = 0;
  std::size_t part_count = 0;
  /// From where the scene has them to where they are, in the world.
  std::function<Eigen::Isometry3d(double time_s)> motion;
};

/// A scene and how it is filmed.
struct SceneRecipe {
  std::string name;
  SyntheticScene scene;
  CameraPath path;                                       ///< smooth, at most about 0.35 m/s and 25 degrees/s
  int frames = 0;                                        ///< length of the recording where none is asked for
  Eigen::Vector3d lit_center = Eigen::Vector3d::Zero();  ///< shadows reach `lit_radius_m` around it
  double lit_radius_m = 1.5;
  std::vector<AnimatedPart> animated_parts = {};
};

/// A table with 17 things, 0.8 - 1.1 m away; the camera walks around it (300 frames: nearly half the way).
[[nodiscard]] SceneRecipe makeTabletopSet();

/// A room with table, 17 things on it, chair, stool, basket, parcel, shelf; 400 frames. In the first views
/// the chair cuts the floor in separate pieces; the camera then steps back and around it, and goes on to the
/// table.
[[nodiscard]] SceneRecipe makeRoomSet();

/// A bare wall with what is painted on it: depth does not say where along it the camera is. 300 frames forth
/// and back.
[[nodiscard]] SceneRecipe makeWallSet();

/// A corridor with doors, pillars, pictures, cupboards and parcels, along which the camera walks 60 m at 0.75
/// m/s; 2400 frames. Much more than is in view at any time.
[[nodiscard]] SceneRecipe makeCorridorSet();

/// A room of its own for every seed: 2 - 4 walls with furniture, doors, curtains and pillars, rugs, clutter
/// on the floor, on tables and in shelves, stacked, leaning and touching; 300 frames along the walls.
[[nodiscard]] SceneRecipe makeRandomRoomSet(std::uint32_t seed);

/// Such a room, whose furniture the camera passes as near as 20 cm at a hand's pace: much of what it sees is
/// new, some is too near for a reading; 400 frames. The hard case of tracking.
[[nodiscard]] SceneRecipe makeRandomSweepSet(std::uint32_t seed);

/// A room in which somebody walks past, a hand takes the mug ("mug") from the table and puts it down
/// elsewhere, and the chair ("chair") is pushed away; 420 frames. Another room, and other ways, for every
/// seed.
[[nodiscard]] SceneRecipe makeRandomMovingSet(std::uint32_t seed);

/// A table with things of 5 - 40 cm for every seed; 240 frames around it.
[[nodiscard]] SceneRecipe makeRandomTabletopSet(std::uint32_t seed);

}  // namespace scantrove::synthetic
