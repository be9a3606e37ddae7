#pragma once
#include <optional>
#include <vector>

#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

/// A flat vertical face that things can lean on; viewed from the front, y points into it.
struct Face {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< the middle of its foot
  double yaw_deg = 0;
  double length_m = 0;
  double z = 0;  ///< height of its foot, where leaning things stand
  double height_m = 0;
  double edge_m = 0;  ///< rounding of its upper edge
  std::uint16_t instance = 0;
};

/// Places things in a scene side by side, on, in and against one another, without intersections.
class Layout {
 public:
  struct Filled {
    Volume volume;
    std::uint16_t instance;
  };

  /// `hard_seed`: of the materials of the hard generation, whose things it then chooses and places.
  explicit Layout(std::optional<std::uint32_t> hard_seed = std::nullopt) : hard_seed_(hard_seed) {}
  [[nodiscard]] bool isHard() const { return hard_seed_.has_value(); }

  /// Places a thing at a given pose if it is free (`beside`: an instance it may touch). False: it is
  /// occupied.
  bool put(Thing& thing, double x, double y, double z, double yaw_deg, std::uint16_t beside = 0);
  /// Places it somewhere on the stand, sometimes in contact with other things. False: no free position.
  bool placeOn(HashStream& random, const Stand& stand, Thing& thing);
  /// Leans a board or a pole on the face.
  bool lean(HashStream& random, const Face& face);
  /// Upright books side by side, touching, from left to right.
  void fillWithBooks(HashStream& random, const Stand& stand, int count);
  /// Places things of all kinds on a stand, some stacked, some in a tray or box.
  void clutter(HashStream& random, const Stand& stand, int count);
  /// Places flat things on a stand, some with another thing on them.
  void layFlat(HashStream& random, const Stand& stand, int count);
  /// Stacks `count` things on an existing stand.
  void stack(HashStream& random, const Stand& stand, int count);
  /// Marks space as occupied by an instance that was added to the scene directly (a wall).
  void fill(const Volume& volume, std::uint16_t instance) { filled_.push_back({volume, instance}); }
  void addFace(const Face& face) { faces_.push_back(face); }
  /// Distance from placed volumes to the nearest occupied one in their height, except the instance `beside`.
  /// Negative where they overlap.
  [[nodiscard]] double clearance(const std::vector<Volume>& volumes, std::uint16_t beside) const;
  /// A thing of this generation for floors.
  [[nodiscard]] Thing drawFloorThing(HashStream& random) const;

  SyntheticScene scene;
  [[nodiscard]] const std::vector<Filled>& filled() const { return filled_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  /// Stands of the last placed thing.
  [[nodiscard]] const std::vector<Stand>& newStands() const { return new_stands_; }

 private:
  [[nodiscard]] Thing drawStackable(HashStream& random) const;
  /// Position of the thing after moving from `from` towards a neighbour as far as possible.
  [[nodiscard]] Eigen::Vector2d slideUpTo(HashStream& random, const Stand& stand, const Thing& thing,
                                          const Eigen::Vector2d& from, double yaw_deg) const;
  [[nodiscard]] std::string freeName(const std::string& name) const;
  std::optional<std::uint32_t> hard_seed_;
  std::vector<Filled> filled_;
  std::vector<Face> faces_;
  std::vector<Stand> new_stands_;
};

}  // namespace scantrove::synthetic
