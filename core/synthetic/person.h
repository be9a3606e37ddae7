#pragma once
#include <vector>

#include "core/synthetic/hash_stream.h"
#include "core/synthetic/scene_recipe.h"

namespace scantrove::synthetic {

/// Where something is at some time; in between it goes there smoothly, and before and after it stands still.
struct Waypoint {
  double time_s = 0;
  Vec3 at = Vec3::Zero();
};
[[nodiscard]] Vec3 alongWaypoints(const std::vector<Waypoint>& way, double time_s);

/// Adds a person ("walker", no object) who walks along x at the given y: from `way` to `way`, legs and arms
/// swinging as long as the feet move. Casts no shadow.
void addPerson(HashStream& random, SceneRecipe& set, double y, std::vector<Waypoint> way);

/// Adds a forearm ("arm", no object) that comes from the side `from` (-1: from -x) and rises backwards. Its
/// hand is where `way` has it. Casts no shadow.
void addArm(HashStream& random, SceneRecipe& set, double from, std::vector<Waypoint> way);

}  // namespace scantrove::synthetic
