#pragma once
#include <string>
#include <vector>

#include "core/synthetic/hash_stream.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {

/// A keyed position. Motion between keys is smooth; before the first and after the last it rests.
struct Waypoint {
  double time_s = 0;
  Vec3 at = Vec3::Zero();
};
[[nodiscard]] Vec3 alongWaypoints(const std::vector<Waypoint>& way, double time_s);

/// Adds a person ("person", no object) who walks along x at the given y from key to key of `way`. Legs and
/// arms swing while the feet move. Casts no shadow.
void addPerson(HashStream& random, SceneRecipe& recipe, double y, std::vector<Waypoint> way);

/// Adds a forearm ("arm", no object) that enters from side `from` (-1: from -x) and rises backwards. `way`
/// gives the hand's position. Casts no shadow.
void addArm(HashStream& random, SceneRecipe& recipe, double from, std::vector<Waypoint> way);

inline constexpr double kFingerRadius_m = 0.008;

/// A hand that grips from above.
struct HandMotion {
  std::string name;               ///< of its instance
  double side = 1;                ///< 1: a right hand, -1: a left hand
  double yaw_deg = 0;             ///< 0: the arm comes from -y; turned around the vertical
  std::vector<Waypoint> way;      ///< of the point between the finger tips
  std::vector<Waypoint> opening;  ///< `at.x()`: distance of the finger tips from that point
};

/// Adds a hand with its forearm, no object. Casts no shadow.
void addHand(HashStream& random, SceneRecipe& recipe, const HandMotion& motion);

}  // namespace scantrove::synthetic
