#include "core/capture/local_poses.h"

#include <spdlog/spdlog.h>

#include <sstream>
#include <string>
#include <utility>

namespace scantrove {
namespace {

/// Exceeds every distance on earth and all map coordinates.
constexpr double kLargest_m = 1e8;
/// Number of consecutive frames at a new position that count as a cut in the recording.
constexpr int kAgreeingFrames = 3;

std::string meters(double value) {
  std::ostringstream text;
  text.precision(3);
  if (value < 1000) {
    text << value << " m";
  } else {
    text << value / 1000 << " km";
  }
  return text.str();
}

Eigen::Vector3d originFor(const Eigen::Vector3d& place) {
  if (place.norm() <= LocalPoses::kNearOrigin_m) return Eigen::Vector3d::Zero();
  return place.array().round();
}

}  // namespace

std::optional<FrameRead> LocalPoses::nextIfReady() {
  std::optional<FrameRead> read = source_->nextIfReady();
  if (!read) return read;
  return moved(std::move(*read));
}

void LocalPoses::forget() {
  origin_.reset();
  last_.reset();
  elsewhere_.reset();
  agreeing_ = 0;
}

bool LocalPoses::isJump(const Eigen::Vector3d& place) {
  if (!last_ || (place - *last_).norm() <= kLongestJump_m) return false;
  const bool agrees = elsewhere_ && (place - *elsewhere_).norm() <= kLongestJump_m;
  agreeing_ = agrees ? agreeing_ + 1 : 1;
  elsewhere_ = place;
  return agreeing_ < kAgreeingFrames;
}

std::string LocalPoses::refusalOf(const Eigen::Isometry3d& T_world_camera) {
  if (!T_world_camera.matrix().allFinite()) return "is not finite";
  const Eigen::Vector3d place = T_world_camera.translation();
  if (place.cwiseAbs().maxCoeff() > kLargest_m)
    return "lies " + meters(place.norm()) + " from the recording's origin, where no camera is";
  if (origin_ && (place - *origin_).norm() > kFarthest_m)
    return "lies " + meters((place - *origin_).norm()) + " from where the scan began";
  if (isJump(place)) return "jumps by " + meters((place - *last_).norm());
  return {};
}

FrameRead LocalPoses::moved(FrameRead read) {
  if (read.status != FrameRead::Status::frame || !read.frame.T_world_camera) return read;
  Eigen::Isometry3d& T_world_camera = *read.frame.T_world_camera;
  const Eigen::Vector3d place = T_world_camera.translation();
  if (const std::string refusal = refusalOf(T_world_camera); !refusal.empty()) {
    if (implausible_ == Implausible::without_pose) {
      read.frame.T_world_camera.reset();
      if (!std::exchange(has_reported_, true))
        spdlog::warn("The pose of frame {} {} and is not used, nor are others like it.", read.frame.index,
                     refusal);
      return read;
    }
    read.status = FrameRead::Status::skipped;
    read.error = {
        "The pose of frame " + std::to_string(read.frame.index) + " " + refusal + ": the frame is left out.",
        "Poses are camera to world, in metres."};
    return read;
  }
  if (!origin_) origin_ = originFor(place);
  last_ = place;
  elsewhere_.reset();
  T_world_camera.translation() -= *origin_;
  return read;
}

}  // namespace scantrove
