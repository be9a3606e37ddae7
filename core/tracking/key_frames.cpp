#include "core/tracking/key_frames.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/capture/usable_depth.h"
#include "core/tracking/feature_matching.h"
#include "core/tracking/view_distance.h"

namespace scantrove {
namespace {

// At this distance or rotation a fifth of the view is new, and features begin to be lost.
constexpr ViewReach kNewKeyFrame{.angle_rad = 0.22, .distance_m = 0.20};
constexpr double kNear = 3;  ///< times kNewKeyFrame: near enough to share much of the view
const cv::Size kThumbnail(40, 30);
constexpr std::size_t kByThumbnail = 24;  // key frames with compared features; bounds the cost
constexpr int kProbes = 200;              // compared features of the view
constexpr int kAlikeBits = 50;            // of 256: most different bits of descriptors of the same point
// Nearest valid reading of a thumbnail without colour.
constexpr float kNearestReading_m = 0.1F;
// The blur of a thumbnail tolerates small displacements of the camera.
const cv::Size kBlur(5, 5);
constexpr double kBlurSigma_px = 1.5;

/// Number of the view's strongest features that match the key frame's.
int sharedFeatures(const ColorView& view, const Landmarks& landmarks) {
  const cv::Mat probes = view.descriptors.rowRange(0, std::min(kProbes, view.descriptors.rows));
  return static_cast<int>(std::ranges::count_if(
      matchAll(probes, landmarks), [](const FeatureMatch& match) { return match.bits <= kAlikeBits; }));
}

}  // namespace

cv::Mat thumbnailOf(const RgbdFrame& frame) {
  cv::Mat small;
  if (!frame.color.empty()) {
    cv::resize(frame.color, small, kThumbnail, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, small, cv::COLOR_BGR2GRAY);
    blankUnscanned(small, frame.scanned);
    small.convertTo(small, CV_32F);
  } else {
    cv::resize(usableDepth(frame), small, kThumbnail, 0, 0, cv::INTER_NEAREST);
    small.convertTo(small, CV_32F, static_cast<double>(frame.meters_per_unit));
    const cv::Mat none = small < kNearestReading_m;
    small = 1 / cv::max(small, kNearestReading_m);
    small.setTo(0, none);
  }
  cv::GaussianBlur(small, small, kBlur, kBlurSigma_px);
  small -= cv::mean(small)[0];
  const double length = cv::norm(small);
  if (!(length > 1e-3)) return {};
  return small / length;
}

bool KeyFrames::isDue(const Eigen::Isometry3d& T_world_camera) const {
  return std::ranges::none_of(key_frames_, [&](const KeyFrame& key_frame) {
    return viewDistance(key_frame.T_world_camera, T_world_camera, kNewKeyFrame) < 1;
  });
}

const KeyFrame* KeyFrames::nearest(const Eigen::Isometry3d& T_world_camera) const {
  const KeyFrame* best = nullptr;
  double least = kNear;
  for (const KeyFrame& key_frame : key_frames_) {
    const double distance = viewDistance(key_frame.T_world_camera, T_world_camera, kNewKeyFrame);
    if (distance >= least) continue;
    least = distance;
    best = &key_frame;
  }
  return best;
}

std::vector<const KeyFrame*> KeyFrames::alike(const cv::Mat& thumbnail, const ColorView& view,
                                              std::size_t most, std::size_t without_newest) const {
  if (thumbnail.empty()) return {};
  struct Scored {
    double score = 0;
    const KeyFrame* key_frame = nullptr;
  };
  std::vector<Scored> found;
  for (std::size_t i = 0; i + without_newest < key_frames_.size(); ++i) {
    const KeyFrame& key_frame = key_frames_[i];
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

double KeyFrames::distanceSince(const KeyFrame& key_frame) const {
  double way = 0;
  for (std::size_t i = key_frames_.size(); i-- > 1 && &key_frames_[i] != &key_frame;) {
    const Eigen::Isometry3d step =
        key_frames_[i - 1].T_world_camera.inverse() * key_frames_[i].T_world_camera;
    way += step.translation().norm() + Eigen::AngleAxisd(step.linear()).angle();
  }
  return way;
}

}  // namespace scantrove
