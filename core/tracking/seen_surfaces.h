#pragma once
#include <Eigen/Geometry>
#include <deque>

#include "core/tracking/stored_surface.h"

namespace scantrove {

/// Surfaces that the depth camera saw along its path. A returning camera is registered against them, which
/// removes the drift of the map since. They lie denser than key frames, because a registration slides when
/// systematic depth errors differ: already over a hand's width. One thread.
class SeenSurfaces {
 public:
  struct View {
    Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
    StoredSurface surface;
    bool is_revisitable = false;  ///< the camera has been far away since
  };

  SeenSurfaces() = default;
  explicit SeenSurfaces(std::deque<View> views) : views_(std::move(views)) {}

  /// Whether no view is stored near this pose.
  [[nodiscard]] bool isDue(const Eigen::Isometry3d& T_world_camera) const;
  /// Earlier views keep their addresses.
  void add(const Eigen::Isometry3d& T_world_camera, StoredSurface surface) {
    views_.push_back({T_world_camera, std::move(surface)});
  }
  /// Marks the views far from the present pose as revisitable.
  void markRevisitable(const Eigen::Isometry3d& T_world_camera);
  [[nodiscard]] const std::deque<View>& all() const { return views_; }

  /// The nearest revisitable view that is seen again, or null.
  [[nodiscard]] const View* nearestSeenAgain(const Eigen::Isometry3d& T_world_camera) const;

 private:
  std::deque<View> views_;
};

}  // namespace scantrove
