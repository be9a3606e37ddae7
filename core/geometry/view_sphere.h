#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace scantrove {

/// The sphere of viewing directions around one object of one scan: decides which views are new enough to
/// keep. Directions are vectors from the object's centroid to the camera in the world of *this* scan, of any
/// length; views of earlier scans lie in other worlds and have no direction here.
class ViewSphere {
 public:
  ViewSphere() = default;
  /// `unit_directions`: from directions().
  explicit ViewSphere(std::vector<Eigen::Vector3f> unit_directions)
      : directions_(std::move(unit_directions)) {}

  /// True when the angle to every stored direction is at least `angle_deg`. False for a direction that is not
  /// a finite, non-zero vector.
  [[nodiscard]] bool isNew(const Eigen::Vector3f& direction, float angle_deg) const;
  void keep(const Eigen::Vector3f& direction) { directions_.push_back(direction.normalized()); }
  [[nodiscard]] const std::vector<Eigen::Vector3f>& directions() const { return directions_; }

 private:
  std::vector<Eigen::Vector3f> directions_;  // unit
};

}  // namespace scantrove
