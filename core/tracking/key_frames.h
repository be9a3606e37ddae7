#pragma once
#include <Eigen/Geometry>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/tracking/color_view.h"

namespace scantrove {

/// A tracking key frame, used for relocalisation.
struct KeyFrame {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  Landmarks landmarks;
  cv::Mat thumbnail;  ///< of its frame (thumbnailOf)
};

/// A frame as 40 x 30 numbers of mean 0 and length 1, CV_32FC1: its blurred grey image or, without colour,
/// its blurred inverse depth. Empty: the image is uniform.
[[nodiscard]] cv::Mat thumbnailOf(const RgbdFrame& frame);

/// The tracking key frames of a map, one for each place and direction of view. One thread.
class KeyFrames {
 public:
  KeyFrames() = default;
  explicit KeyFrames(std::deque<KeyFrame> key_frames) : key_frames_(std::move(key_frames)) {}

  /// Whether no key frame shows the view from this pose.
  [[nodiscard]] bool isDue(const Eigen::Isometry3d& T_world_camera) const;
  /// Earlier key frames keep their addresses.
  void add(KeyFrame key_frame) { key_frames_.push_back(std::move(key_frame)); }
  [[nodiscard]] const std::deque<KeyFrame>& all() const { return key_frames_; }
  [[nodiscard]] std::size_t size() const { return key_frames_.size(); }

  /// The key frame with the nearest view to this pose; null: none is near.
  [[nodiscard]] const KeyFrame* nearest(const Eigen::Isometry3d& T_world_camera) const;
  /// At most `most` key frames that may show the same place, most likely first: by thumbnail, then by
  /// features. Skips the `without_newest` newest ones.
  [[nodiscard]] std::vector<const KeyFrame*> alike(const cv::Mat& thumbnail, const ColorView& view,
                                                   std::size_t most, std::size_t without_newest = 0) const;

  /// Length of the camera's path since `key_frame`, one of these, along the later ones: metres plus radians.
  [[nodiscard]] double distanceSince(const KeyFrame& key_frame) const;

 private:
  std::deque<KeyFrame> key_frames_;
};

}  // namespace scantrove
