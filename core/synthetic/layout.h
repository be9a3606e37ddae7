#pragma once
#include <vector>

#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

/// A flat upright face that things can lean on: seen from before it, y points into it.
struct Face {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< the middle of its foot
  double yaw_deg = 0;
  double length_m = 0;
  double z = 0;  ///< of its foot, where what leans stands
  double height_m = 0;
  double edge_m = 0;  ///< its upper edge is rounded so much
  std::uint16_t instance = 0;
};

/// A scene in which things are put side by side, on, in and against one another, and never into each other.
class Layout {
 public:
  struct Filled {
    Volume volume;
    std::uint16_t instance;
  };

  /// Puts a thing there if nothing is in the way (`beside`: an instance that may be). False: it is.
  bool put(Thing& thing, double x, double y, double z, double yaw_deg, std::uint16_t beside = 0);
  /// Puts it somewhere on the stand, at times up to what is already there. False: no place was found.
  bool placeOn(HashStream& random, const Stand& stand, Thing& thing);
  /// Leans a board or a pole on the face.
  bool lean(HashStream& random, const Face& face);
  /// Upright books side by side, touching, from left to right.
  void fillWithBooks(HashStream& random, const Stand& stand, int count);
  /// Things of all kinds on a stand, some stacked, some in a tray or box.
  void clutter(HashStream& random, const Stand& stand, int count);
  /// `count` things on one another, from a stand that is already there.
  void stack(HashStream& random, const Stand& stand, int count);
  /// Space that is taken, of an instance that was added to the scene directly (a wall).
  void fill(const Volume& volume, std::uint16_t instance) { filled_.push_back({volume, instance}); }
  void addFace(const Face& face) { faces_.push_back(face); }

  SyntheticScene scene;
  [[nodiscard]] const std::vector<Filled>& filled() const { return filled_; }
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  /// Those of the thing that was put last.
  [[nodiscard]] const std::vector<Stand>& newStands() const { return new_stands_; }

 private:
  [[nodiscard]] double clearance(const std::vector<Volume>& volumes, std::uint16_t beside) const;
  /// The thing's way from `from` towards one of its neighbours, as far as it goes.
  [[nodiscard]] Eigen::Vector2d slideUpTo(HashStream& random, const Stand& stand, const Thing& thing,
                                          const Eigen::Vector2d& from, double yaw_deg) const;
  [[nodiscard]] std::string freeName(const std::string& name) const;
  std::vector<Filled> filled_;
  std::vector<Face> faces_;
  std::vector<Stand> new_stands_;
};

}  // namespace scantrove::synthetic
