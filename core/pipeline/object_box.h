#pragma once
#include <Eigen/Geometry>
#include <span>

namespace scantrove {

/// A box around the object that is scanned, in a frame of its own: x to the right and y away as the first
/// image shows them, z up. Metres.
struct ObjectBox {
  Eigen::AlignedBox3d bounds;
  bool stands = false;  ///< z = 0 is the plane on which the object stands; nothing of the object is below
  bool grows = false;   ///< it follows what is connected with the object

  /// Extends the box to the points, in its frame, by at most a little in each direction. A few outliers count
  /// for nothing.
  void growTo(std::span<const Eigen::Vector3d> points);
};

}  // namespace scantrove
