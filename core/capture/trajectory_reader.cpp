#include "core/capture/trajectory_reader.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/capture/folder_listing.h"
#include "core/capture/icl_nuim.h"
#include "core/capture/pose_files.h"
#include "core/capture/recorded_poses.h"
#include "core/capture/time_unit.h"

namespace scantrove {

namespace {

namespace fs = std::filesystem;

Result<Trajectory> readLog(const fs::path& file) {
  const auto numbered = readTrajectoryLog(file);
  if (!numbered) {
    return fail(numbered.error());
  }
  Trajectory poses;
  for (const NumberedPose& pose : *numbered) {
    poses.push_back({pose.number / kFrameRateHz, pose.T_world_camera});
  }
  return poses;
}

Result<Trajectory> readTimedLines(const fs::path& file) {
  Result<Trajectory> poses = readTumTrajectory(file);
  if (!poses) return poses;
  const TimeUnit unit = unitOfPoseTimes(*poses);
  if (unit != TimeUnit()) spdlog::warn("{}: by their spacing, its times are {}.", file.string(), unit.name);
  for (StampedPose& pose : *poses) pose.timestamp_s *= unit.seconds;
  return poses;
}

/// ICL-NUIM's poses, which count frames, as the recording has them.
Result<Trajectory> readFramePoses(const fs::path& file) {
  const auto numbered = readIclNuimPoses(file, true);
  if (!numbered) return fail(numbered.error());
  Trajectory poses;
  for (const NumberedPose& pose : *numbered)
    poses.push_back({pose.number / kFrameRateHz, pose.T_world_camera});
  return poses;
}

Result<Trajectory> readPoses(const fs::path& file) {
  Result<Trajectory> poses = file.extension() == ".log"        ? readLog(file)
                             : file.extension() == ".freiburg" ? readFramePoses(file)
                                                               : readTimedLines(file);
  if (poses && poses->empty()) {
    return fail("There is no pose in " + file.string() + ".");
  }
  return poses;
}

/// Reads frame-NNNNNN.pose.txt. Skips files without a pose, which a tracker writes while lost; other contents
/// are an error.
Result<Trajectory> readPoseFiles(const fs::path& folder, const std::vector<std::string>& names) {
  Trajectory poses;
  for (const std::string& name : names) {
    const auto part = sevenScenesPart(name);
    if (!part || part->suffix != "pose.txt") {
      continue;
    }
    const auto matrix = readMatrixFile(folder / name);
    if (!matrix) {
      return fail(matrix.error());
    }
    if (const auto pose = rigidMotion(*matrix)) {
      poses.push_back({part->number / kFrameRateHz, *pose});
    }
  }
  return poses;
}

Result<Trajectory> readFolder(const fs::path& folder) {
  const auto names = listFolder(folder);
  if (!names) {
    return fail(names.error());
  }
  if (const auto name = iclNuimPoseFile(*names)) return readPoses(folder / *name);
  for (const char* const name : {"groundtruth.txt", "trajectory.txt", "trajectory.log"}) {
    if (std::ranges::count(*names, name) > 0) {
      return readPoses(folder / name);
    }
  }
  auto poses = readPoseFiles(folder, *names);
  if (!poses || !poses->empty()) {
    return poses;
  }
  if (const auto log = findTrajectoryLog(folder)) {
    return readPoses(*log);
  }
  return fail("There are no poses in " + folder.string() + ".",
              "Looked for groundtruth.txt, trajectory.txt, trajectory.log and frame-NNNNNN.pose.txt.");
}

}  // namespace

Result<Trajectory> readTrajectory(const fs::path& path) {
  std::error_code error;
  auto poses = fs::is_directory(path, error) ? readFolder(path) : readPoses(path);
  if (poses) {
    std::ranges::stable_sort(*poses, {}, &StampedPose::timestamp_s);
  }
  return poses;
}

}  // namespace scantrove
