#pragma once
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"
#include "core/pipeline/object_box.h"

namespace scantrove {

/// What a person says of the object that is scanned alone.
struct ObjectChoice {
  std::optional<Eigen::Vector3d> box_m =
      {};  ///< width, depth and height around it; none: found, and it grows
  std::optional<Eigen::Vector2d> at_px = {};  ///< in the first depth image; none: the image's middle

  bool operator==(const ObjectChoice&) const = default;
};

/// Keeps one object of each frame and leaves out the depth of everything else, so that the tracker follows
/// the object alone: the camera's poses are relative to the object, and the room may turn or stand.
///
/// The first frame shows the plane on which the object stands, and the object near the image's middle. A box
/// around it is fixed to the object and follows the tracked poses. A turntable turns about the normal of its
/// plane, so the plane stays where it is in the object's frame. Without a plane the object is held in a hand:
/// then the box in front of the camera alone counts. One thread.
class ObjectMask {
 public:
  /// `K`: of depth images of frames without their own intrinsics.
  ObjectMask(const Intrinsics& K, const ObjectChoice& choice) : K_(K), choice_(choice) {}

  /// The frame with the object's depth alone, and with RgbdFrame::scanned. Without depth while no object is
  /// found.
  [[nodiscard]] RgbdFrame apply(const RgbdFrame& frame);
  /// Call after apply() with the pose of that frame if it is usable; the box follows and grows.
  void follow(const Eigen::Isometry3d& T_map_camera);
  /// A new map begins: the object is searched again.
  void restart();

  /// The object's pixels in the last frame, 255, of the depth image's size.
  [[nodiscard]] const cv::Mat1b& mask() const { return mask_; }
  [[nodiscard]] bool isFound() const { return box_.has_value(); }
  /// Requires isFound().
  [[nodiscard]] const ObjectBox& box() const { return *box_; }

 private:
  /// Finds plane and box in the frame.
  void find(const RgbdFrame& frame, const Intrinsics& K);
  /// The camera's expected pose in the frame of the box.
  [[nodiscard]] Eigen::Isometry3d expectedPose() const;
  void select(const RgbdFrame& frame, const Intrinsics& K);

  Intrinsics K_;
  ObjectChoice choice_;
  std::optional<ObjectBox> box_;
  Eigen::Isometry3d T_box_camera_ = Eigen::Isometry3d::Identity();  // of the frame in which it was found
  std::optional<Eigen::Isometry3d> T_box_map_;                      // once that frame has a pose
  std::optional<Eigen::Isometry3d> last_, before_last_;             // T_map_camera of usable frames in a row
  bool is_followed_ = true;                                         // the last frame had a pose
  bool has_gap_ = false;                                            // frames without a pose followed last_
  cv::Mat1b mask_;
  std::vector<Eigen::Vector3d> points_camera_;  // of its pixels with depth
};

}  // namespace scantrove
