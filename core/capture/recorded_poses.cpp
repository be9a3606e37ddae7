#include "core/capture/recorded_poses.h"

#include <algorithm>
#include <cmath>

#include "core/capture/folder_listing.h"

namespace scantrove {

namespace {

constexpr double kLargestGapSeconds = 0.1;
constexpr double kNearestPoseSeconds = 0.02;

}  // namespace

std::optional<std::filesystem::path> findTrajectoryLog(const std::filesystem::path& folder) {
  constexpr const char* kName = "trajectory.log";
  std::error_code error;
  if (std::filesystem::is_regular_file(folder / kName, error)) {
    return folder / kName;
  }
  const auto names = listFolder(folder);
  for (const std::string& name : names.value_or(std::vector<std::string>())) {
    if (std::filesystem::is_regular_file(folder / name / kName, error)) {
      return folder / name / kName;
    }
  }
  return std::nullopt;
}

std::optional<Eigen::Isometry3d> poseAt(const Trajectory& trajectory, double timestamp_s) {
  const auto after =
      std::lower_bound(trajectory.begin(), trajectory.end(), timestamp_s,
                       [](const StampedPose& pose, double time) { return pose.timestamp_s < time; });
  if (after != trajectory.end() && after != trajectory.begin()) {
    const StampedPose& next = *after;
    const StampedPose& previous = *(after - 1);
    const double gap = next.timestamp_s - previous.timestamp_s;
    if (gap > 0 && gap < kLargestGapSeconds) {
      const double part = (timestamp_s - previous.timestamp_s) / gap;
      const Eigen::Quaterniond from(previous.T_world_camera.linear());
      const Eigen::Quaterniond to(next.T_world_camera.linear());
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = from.slerp(part, to).normalized().toRotationMatrix();
      pose.translation() =
          (1 - part) * previous.T_world_camera.translation() + part * next.T_world_camera.translation();
      return pose;
    }
  }
  const StampedPose* nearest = nullptr;
  double smallest = kNearestPoseSeconds;
  const auto consider = [&](const StampedPose& pose) {
    if (const double distance = std::abs(pose.timestamp_s - timestamp_s); distance <= smallest) {
      smallest = distance;
      nearest = &pose;
    }
  };
  if (after != trajectory.end()) {
    consider(*after);
  }
  if (after != trajectory.begin()) {
    consider(*(after - 1));
  }
  return nearest == nullptr ? std::nullopt : std::optional(nearest->T_world_camera);
}

}  // namespace scantrove
