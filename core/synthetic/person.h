#pragma once
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

}  // namespace scantrove::synthetic
