#pragma once
#include <string>
#include <vector>

#include "core/synthetic/footprint.h"
#include "core/synthetic/hash_stream.h"
#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// Somewhere flat that things can stand on.
struct Stand {
  Footprint area;
  double z = 0;
  double headroom_m = 10;  ///< free height above it
};

/// A thing of a random scene before it has a place, in its own frame: it stands on z = 0; what leans on walls
/// has its back at y = 0 and its front towards -y.
struct Thing {
  /// Takes the only instance of `built`; one volume around it (a round one if asked), moved so that its foot
  /// is at z = 0.
  explicit Thing(SyntheticScene&& built, bool round = false);

  /// Others may stand on its top, this far from the rim.
  Thing& withTop(double rim_m);
  /// Others may lean on its sides; their upper edges are rounded with `round_m`.
  Thing& withSides(double round_m);
  /// Laid on its side: the axis z turned to y.
  Thing& layDown();
  [[nodiscard]] double height() const;

  InstanceName who;
  std::vector<SyntheticScene::Part> parts;
  std::vector<Volume> volumes;
  std::vector<Stand> stands;
  double side_round_m =
      -1;  ///< rounding of its sides' upper edge where other things may lean on it, else < 0

 private:
  void enclose(bool round);
};

/// How far all parts together reach along a unit direction, in the frame that their poses lead to.
[[nodiscard]] double reachOf(const std::vector<SyntheticScene::Part>& parts, const Vec3& direction);

// Random things. Sizes, shapes and colours are the stream's.
[[nodiscard]] Thing makeSmallThing(HashStream& random);   ///< 5 - 40 cm, for tables and shelves
[[nodiscard]] Thing makeStackable(HashStream& random);    ///< a carton, a book, a block: flat above
[[nodiscard]] Thing makeFloorThing(HashStream& random);   ///< 20 cm - 1 m: chair, basket, parcel, suitcase
[[nodiscard]] Thing makeContainer(HashStream& random);    ///< a tray or an open box; its stand is inside
[[nodiscard]] Thing makeUprightBook(HashStream& random);  ///< spine towards -y
/// A board, a picture, a pole that leans with its upper end on a wall (y = 0 and behind it) whose upper edge
/// is at `wall_height_m`, rounded with `edge_m`; its foot stands on z = 0.
[[nodiscard]] Thing makeLeaning(HashStream& random, double wall_height_m, double edge_m);

// Furniture; stays where it is, and is no object.
[[nodiscard]] Thing makeRandomTable(HashStream& random, const Vec3& size);  ///< on legs or one foot
[[nodiscard]] Thing makeDesk(HashStream& random, double length);            ///< with drawers on one side
[[nodiscard]] Thing makeCupboard(HashStream& random, const Vec3& size);     ///< doors or drawers with handles
[[nodiscard]] Thing makeBookcase(HashStream& random, const Vec3& size);     ///< open shelves
[[nodiscard]] Thing makeSofa(HashStream& random, double length);
[[nodiscard]] Thing makeBed(HashStream& random, double length);
[[nodiscard]] Thing makePillar(HashStream& random);
[[nodiscard]] Thing makeDoor(HashStream& random);  ///< door and frame
[[nodiscard]] Thing makeCurtain(HashStream& random, double length);
[[nodiscard]] Thing makeRug(HashStream& random);

}  // namespace scantrove::synthetic
