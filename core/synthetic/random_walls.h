#pragma once
#include "core/synthetic/layout.h"
#include "core/synthetic/objects.h"

namespace scantrove::synthetic {

/// A rectangle of floor around the origin, x by y metres, with walls on some of its sides.
struct Shell {
  double width = 4, depth = 4;

  /// Of the walls back (+y), right, front, left: 0 ... 3. The way from a point on the floor plan to the
  /// wall's own frame: x along it, y into it, its face at y = 0.
  [[nodiscard]] Place wallPlace(int wall) const;
  [[nodiscard]] double wallLength(int wall) const { return wall % 2 == 0 ? width : depth; }
};

constexpr double kSkirting_m = 0.015;  ///< furniture stands so far from the wall

/// The floor, with boards, tiles or carpet, and 30 cm more of it where there is no wall.
void addRandomFloor(HashStream& random, Layout& layout, const Shell& shell);
/// A wall with its skirting, 2.5 m high.
void addRandomWall(HashStream& random, Layout& layout, const Shell& shell, int wall);
/// Furniture, doors, curtains and pillars along a wall, from one end to the other, with gaps or without, and
/// things in and on them.
void furnishWall(HashStream& random, Layout& layout, const Shell& shell, int wall);

}  // namespace scantrove::synthetic
