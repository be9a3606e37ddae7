#pragma once
#include <Eigen/Geometry>
#include <deque>

#include "core/tracking/stored_surface.h"

namespace scantrove {

/// What the depth camera saw all along its way: where it comes back, it stands to that as it did, however the
/// map has drifted since. Nearer to each other than the places that a lost camera is found by: from a hand's
/// width away, readings that are off together (by the lens, by the distance) let a registration slide. One
/// thread.
class SeenSurfaces {
 public:
  struct View {
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    StoredSurface surface;
    bool is_left = false;  ///< the camera has been away from there since
  };

  SeenSurfaces() = default;
  explicit SeenSurfaces(std::deque<View> views) : views_(std::move(views)) {}

  /// Whether nothing was kept from near there.
  [[nodiscard]] bool isDue(const Eigen::Isometry3d& T_world_camera) const;
  /// Those that are there stay where they are.
  void add(const Eigen::Isometry3d& T_world_camera, StoredSurface surface) {
    views_.push_back({T_world_camera, std::move(surface)});
  }
  /// The camera is there now: views that it is away from are left.
  void leaveAllExcept(const Eigen::Isometry3d& T_world_camera);
  [[nodiscard]] const std::deque<View>& all() const { return views_; }

  /// The nearest of those that the camera has come back to, or null.
  [[nodiscard]] const View* nearestSeenAgain(const Eigen::Isometry3d& T_world_camera) const;

 private:
  std::deque<View> views_;
};

}  // namespace scantrove
