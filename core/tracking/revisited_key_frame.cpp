#include "core/tracking/revisited_key_frame.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/tracking/landmark_pose.h"

namespace scantrove {
namespace {

/// The newest key frames, which the camera has just passed: about two metres, or a turn.
constexpr std::size_t kNewest = 8;
/// Number of the most likely earlier ones that are checked.
constexpr std::size_t kKeyFramesToAsk = 3;
/// Landmarks that must match, and the least number of 48 cells with them: a poster of the same kind covers
/// few.
constexpr std::size_t kMinSeen = 50;
constexpr int kCellsSeen = 6;
/// Part of the path since then. A larger drift is implausible: the match is a similar door or poster
/// elsewhere.
constexpr double kMaxDriftPerMeter = 0.1;
constexpr double kMinToJudge_m = 0.1;  // uncertainty of poses by landmarks alone

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Distance between the landmarks and the map's surface that shows them now: the median along each axis,
/// which is robust to noise and to a few mismatches.
std::optional<RevisitedKeyFrame> driftOf(const SeenLandmarks& seen, const SurfaceInView& surface) {
  std::array<std::vector<double>, 3> along;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const Eigen::Vector2f pixel = seen.pixels[i].cast<float>();
    const auto now = surface.at({pixel.x(), pixel.y()});
    if (!now) continue;
    const Eigen::Vector3d moved = now->cast<double>() - seen.points_world[i];
    for (std::size_t axis = 0; axis < along.size(); ++axis)
      along[axis].push_back(moved(static_cast<Eigen::Index>(axis)));
  }
  if (along[0].size() < kMinSeen) return std::nullopt;
  const int landmarks = static_cast<int>(along[0].size());
  const Eigen::Vector3d drift(medianOf(along[0]), medianOf(along[1]), medianOf(along[2]));
  return RevisitedKeyFrame{drift.norm(), landmarks};
}

}  // namespace

std::optional<RevisitedKeyFrame> returnedTo(const KeyFrames& places, const cv::Mat& thumbnail,
                                            const ColorView& view, const SurfaceInView& surface) {
  if (places.size() <= kNewest || view.pixels.empty()) return std::nullopt;
  for (const KeyFrame* place : places.alike(thumbnail, view, kKeyFramesToAsk, kNewest)) {
    const std::optional<LandmarkPose> found = locate(view, place->landmarks);
    if (!found || found->seen.pixels.size() < kMinSeen || found->seen.cells() < kCellsSeen) continue;
    const std::optional<RevisitedKeyFrame> returned = driftOf(found->seen, surface);
    const double most_m = std::max(kMinToJudge_m, kMaxDriftPerMeter * places.distanceSince(*place));
    if (returned && returned->drift_m <= most_m) return returned;
  }
  return std::nullopt;
}

}  // namespace scantrove
