#pragma once
#include "core/synthetic/layout.h"
#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {

/// A floor rectangle around the origin, x by y metres, with walls on some sides.
struct Shell {
  double width = 4, depth = 4;

  /// Pose of a wall in the floor plan; walls: back (+y), right, front, left = 0 ... 3. Wall frame: x along
  /// the wall, y into it, its face at y = 0.
  [[nodiscard]] Place wallPlace(int wall) const;
  [[nodiscard]] double wallLength(int wall) const { return wall % 2 == 0 ? width : depth; }
};

constexpr double kSkirting_m = 0.015;  ///< gap between furniture and wall

/// The floor of boards, tiles or carpet, extended by 30 cm on sides without a wall.
void addRandomFloor(HashStream& random, Layout& layout, const Shell& shell);
/// A wall with its skirting, 2.5 m high.
void addRandomWall(HashStream& random, Layout& layout, const Shell& shell, int wall);
/// Places furniture, doors, curtains and pillars along a whole wall, with or without gaps, and things in and
/// on them.
void furnishWall(HashStream& random, Layout& layout, const Shell& shell, int wall);

}  // namespace scantrove::synthetic
