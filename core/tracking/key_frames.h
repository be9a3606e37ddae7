#pragma once
#include <Eigen/Geometry>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/tracking/color_view.h"

namespace scantrove {

/// A frame that the camera can be found by again.
struct KeyFrame {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Landmarks landmarks;
  cv::Mat thumbnail;  ///< of thumbnailOf
};

/// A frame as 40 x 30 numbers of mean 0 and length 1, CV_32FC1: its blurred colour image as grey, or, without
/// colour, what is near. Empty: it shows nothing.
[[nodiscard]] cv::Mat thumbnailOf(const RgbdFrame& frame);

/// The places that the camera has seen, one key frame for each direction of view. One thread.
class KeyFrames {
 public:
  KeyFrames() = default;
  explicit KeyFrames(std::deque<KeyFrame> key_frames) : key_frames_(std::move(key_frames)) {}

  /// Whether the camera looks at something from where no key frame was.
  [[nodiscard]] bool isDue(const Eigen::Isometry3d& T_world_camera) const;
  /// Those that are there stay where they are.
  void add(KeyFrame key_frame) { key_frames_.push_back(std::move(key_frame)); }
  [[nodiscard]] const std::deque<KeyFrame>& all() const { return key_frames_; }
  [[nodiscard]] std::size_t size() const { return key_frames_.size(); }

  /// The one that sees most like a camera there, or null: none is near.
  [[nodiscard]] const KeyFrame* nearest(const Eigen::Isometry3d& T_world_camera) const;
  /// Those that may show what the frame shows, the likeliest first: looked for by thumbnail, then by
  /// features. The `without_newest` that were added last are left aside.
  [[nodiscard]] std::vector<const KeyFrame*> alike(const cv::Mat& thumbnail, const ColorView& view,
                                                   std::size_t most, std::size_t without_newest = 0) const;

  /// How far the camera has come since the key frame, which is one of these, as far as the later ones tell:
  /// metres, and as many for each radian that it turned.
  [[nodiscard]] double distanceSince(const KeyFrame& key_frame) const;

 private:
  std::deque<KeyFrame> key_frames_;
};

}  // namespace scantrove
