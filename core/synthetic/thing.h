#pragma once
#include <string>
#include <vector>

#include "core/synthetic/footprint.h"
#include "core/synthetic/hash_stream.h"
#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// A flat area on which things can stand.
struct Stand {
  Footprint area;
  double z = 0;
  double headroom_m = 10;  ///< free height above it
};

/// An unplaced thing of a random scene in its own frame, standing on z = 0. Things that lean on walls have
/// their back at y = 0 and their front towards -y.
struct Thing {
  /// Takes the only instance of `built`. One volume (round if requested) encloses it; its foot moves to z =
  /// 0.
  explicit Thing(SyntheticScene&& built, bool round = false);

  /// Other things may stand on its top, this far from the rim.
  Thing& withTop(double rim_m);
  /// Other things may lean on its sides; their upper edges are rounded with `round_m`.
  Thing& withSides(double round_m);
  /// Lays it on its side: axis z becomes y.
  Thing& layDown();
  [[nodiscard]] double height() const;

  InstanceName who;
  std::vector<SyntheticScene::Part> parts;
  std::vector<Volume> volumes;
  std::vector<Stand> stands;
  double side_round_m = -1;  ///< rounding of its sides' upper edge if other things may lean on it, else < 0

 private:
  void enclose(bool round);
};

/// Support of all parts along a unit direction, in the parent frame of their poses.
[[nodiscard]] double reachOf(const std::vector<SyntheticScene::Part>& parts, const Vec3& direction);

}  // namespace scantrove::synthetic
