#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/synthetic/hard_camera.h"
#include "core/synthetic/lighting.h"
#include "core/synthetic/scene.h"
#include "core/synthetic/trajectory.h"

namespace scantrove::synthetic {

/// Animated parts of a scene.
struct AnimatedPart {
  std::size_t first_part = 0;
  std::size_t part_count = 0;
  /// World motion from the parts' initial to their current poses.
  std::function<Eigen::Isometry3d(double time_s)> motion;
};

/// A scene and its camera path.
struct SceneRecipe {
  std::string name;
  SyntheticScene scene;
  CameraPath path;                                       ///< smooth, at most about 0.35 m/s and 25 degrees/s
  int frames = 0;                                        ///< default length of the recording
  Eigen::Vector3d lit_center = Eigen::Vector3d::Zero();  ///< shadows cover `lit_radius_m` around it
  double lit_radius_m = 1.5;
  std::vector<AnimatedPart> animated_parts = {};
  Lights lights = {};
  std::optional<HardCamera> camera = {};  ///< none: KinectModel's noise alone
  bool is_hand_held = true;               ///< false: the camera has no tremor
  /// World motion of the thing to which poses refer, the identity at time 0. None: poses are the world's.
  std::function<Eigen::Isometry3d(double time_s)> reference = {};
};

// Recipes. Each source (room_scene.cpp, ...) defines one scene, or variants of one.

/// A table with 17 things, 0.8 - 1.1 m away. The camera walks around it; 300 frames cover nearly half the
/// circle.
[[nodiscard]] SceneRecipe makeTabletopScene();

/// A room with table, 17 things on it, chair, stool, basket, parcel, shelf; 400 frames. In the first views
/// the chair splits the floor into separate components. The camera then steps back and around it, and
/// continues to the table.
[[nodiscard]] SceneRecipe makeRoomScene();

/// A bare painted wall: depth does not determine the camera's position along it. 300 frames back and forth.
[[nodiscard]] SceneRecipe makeWallScene();

/// A corridor with doors, pillars, pictures, cupboards and parcels. The camera walks 60 m along it at 0.75
/// m/s, 2400 frames, so the map is much larger than any view.
[[nodiscard]] SceneRecipe makeCorridorScene();

/// A random room for every seed: 2 - 4 walls with furniture, doors, curtains, pillars and rugs. Clutter lies
/// on the floor, on tables and in shelves, stacked, leaning and touching. 300 frames along the walls.
[[nodiscard]] SceneRecipe makeRandomRoomScene(std::uint32_t seed);

/// Such a room, with the camera passing furniture as near as 20 cm at a hand's speed. Much of the view is
/// new, and some is too near for a reading. 400 frames. The hard case of tracking.
[[nodiscard]] SceneRecipe makeRandomSweepScene(std::uint32_t seed);

/// A room in which a person walks past, a hand moves the mug ("mug") on the table, and the chair ("chair") is
/// pushed away. 420 frames; each seed gives another room and other motions.
[[nodiscard]] SceneRecipe makeRandomMovingScene(std::uint32_t seed);

/// A random table with things of 5 - 40 cm for every seed; 240 frames around it.
[[nodiscard]] SceneRecipe makeRandomTabletopScene(std::uint32_t seed);

// The hard generation: random scenes whose camera has the failures of real ones (HardCamera). Surfaces are
// shiny, dark or transparent. Sheets of paper, magazines, cutlery, pens, keyboards and plates lie on tables
// of strong grain or under patterned cloths. Chairs have backs of slats or panels.

/// Such a room; 300 frames, as makeRandomRoomScene().
[[nodiscard]] SceneRecipe makeHardRoomScene(std::uint32_t seed);

/// Such a table; 240 frames, as makeRandomTabletopScene().
[[nodiscard]] SceneRecipe makeHardTabletopScene(std::uint32_t seed);

/// A fixed camera above a table. Two hands ("hand, left", "hand, right", no objects) take three things one
/// after the other, hold them up and put them down elsewhere. 500 frames.
[[nodiscard]] SceneRecipe makeRandomHandsScene(std::uint32_t seed);

/// A fixed camera above a table looks at a turntable ("turntable", no object). On it an asymmetric printed
/// thing ("thing") of 12 - 25 cm turns once around in 240 frames, while the room stands still. Poses are
/// those of the camera around the thing, as if the thing stood still.
[[nodiscard]] SceneRecipe makeRandomTurntableScene(std::uint32_t seed);

}  // namespace scantrove::synthetic
