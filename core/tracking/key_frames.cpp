#include "core/tracking/key_frames.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

constexpr double kNewDirection_rad = 0.22;
constexpr double kNewPlace_m = 0.20;
// Times the distance between key frames: near enough to have much in common, so near that it is much the same
// view, and so far that the camera is somewhere else.
constexpr double kNear = 3;
constexpr double kSamePlace = 1;
constexpr double kAway = 2.5;
const cv::Size kThumbnail(40, 30);
constexpr std::size_t kByThumbnail = 24;  // key frames whose features are compared: bounds the cost
constexpr int kProbes = 200;              // features that are compared
constexpr float kAlikeBits = 50;

/// 1 where a key frame becomes due.
double distanceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d motion = a.inverse() * b;
  return std::max(Eigen::AngleAxisd(motion.linear()).angle() / kNewDirection_rad,
                  motion.translation().norm() / kNewPlace_m);
}

/// How many of the view's strongest features the key frame has.
int sharedFeatures(const ColorView& view, const Landmarks& landmarks) {
  if (view.descriptors.empty() || landmarks.descriptors.empty()) return 0;
  std::vector<cv::DMatch> matches;
  const cv::Mat probes = view.descriptors.rowRange(0, std::min(kProbes, view.descriptors.rows));
  cv::BFMatcher(cv::NORM_HAMMING, true).match(probes, landmarks.descriptors, matches);
  return static_cast<int>(
      std::ranges::count_if(matches, [](const cv::DMatch& match) { return match.distance <= kAlikeBits; }));
}

}  // namespace

cv::Mat thumbnailOf(const RgbdFrame& frame) {
  cv::Mat small;
  if (!frame.color.empty()) {
    cv::resize(frame.color, small, kThumbnail, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, small, cv::COLOR_BGR2GRAY);
    small.convertTo(small, CV_32F);
  } else {
    cv::resize(frame.depth, small, kThumbnail, 0, 0, cv::INTER_NEAREST);
    small.convertTo(small, CV_32F, static_cast<double>(frame.metres_per_unit));
    const cv::Mat none = small < 0.1F;
    small = 1 / cv::max(small, 0.1F);
    small.setTo(0, none);
  }
  cv::GaussianBlur(small, small, {5, 5}, 1.5);
  small -= cv::mean(small)[0];
  const double length = cv::norm(small);
  if (!(length > 1e-3)) return {};
  return small / length;
}

bool KeyFrames::isDue(const Eigen::Isometry3d& T_world_camera) const {
  return std::ranges::none_of(key_frames_, [&](const KeyFrame& key_frame) {
    return distanceBetween(key_frame.T_world_camera, T_world_camera) < 1;
  });
}

const KeyFrame* KeyFrames::nearest(const Eigen::Isometry3d& T_world_camera) const {
  const KeyFrame* best = nullptr;
  double least = kNear;
  for (const KeyFrame& key_frame : key_frames_) {
    const double distance = distanceBetween(key_frame.T_world_camera, T_world_camera);
    if (distance >= least) continue;
    least = distance;
    best = &key_frame;
  }
  return best;
}

void KeyFrames::leaveAllBut(const Eigen::Isometry3d& T_world_camera) {
  for (KeyFrame& key_frame : key_frames_) {
    if (distanceBetween(key_frame.T_world_camera, T_world_camera) > kAway) key_frame.is_left = true;
  }
}

const KeyFrame* KeyFrames::nearestSeenAgain(const Eigen::Isometry3d& T_world_camera) const {
  const KeyFrame* best = nullptr;
  double least = kSamePlace;
  for (const KeyFrame& key_frame : key_frames_) {
    if (!key_frame.is_left) continue;
    const double distance = distanceBetween(key_frame.T_world_camera, T_world_camera);
    if (distance >= least) continue;
    least = distance;
    best = &key_frame;
  }
  return best;
}

std::vector<const KeyFrame*> KeyFrames::alike(const cv::Mat& thumbnail, const ColorView& view,
                                              std::size_t most) const {
  if (thumbnail.empty()) return {};
  struct Scored {
    double score = 0;
    const KeyFrame* key_frame = nullptr;
  };
  std::vector<Scored> found;
  for (const KeyFrame& key_frame : key_frames_) {
    if (!key_frame.thumbnail.empty()) found.push_back({thumbnail.dot(key_frame.thumbnail), &key_frame});
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &Scored::score);
  found.resize(std::min(found.size(), kByThumbnail));
  if (!view.pixels.empty()) {
    for (Scored& one : found) one.score = sharedFeatures(view, one.key_frame->landmarks);
    std::ranges::stable_sort(found, std::ranges::greater(), &Scored::score);
  }
  std::vector<const KeyFrame*> result;
  for (const Scored& one : found) {
    if (result.size() < most) result.push_back(one.key_frame);
  }
  return result;
}

}  // namespace scantrove
