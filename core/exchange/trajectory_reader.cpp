#include "core/exchange/trajectory_reader.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/pose_files.h"
#include "core/base/text_file.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

Result<Trajectory> readLog(const fs::path& path) {
  const Result<std::vector<NumberedPose>> numbered = readTrajectoryLog(path);
  if (!numbered) return fail(numbered.error());
  Trajectory poses;
  for (const NumberedPose& pose : *numbered)
    poses.push_back({pose.number / kFrameRateHz, pose.T_world_camera});
  return poses;
}

Result<Trajectory> readFile(const fs::path& path) {
  Result<Trajectory> poses = path.extension() == ".log" ? readLog(path) : readTumTrajectory(path);
  if (poses && poses->empty()) return fail("There is no pose in " + path.string() + ".");
  return poses;
}

/// The NNNNNN of frame-NNNNNN.pose.txt.
std::optional<int> frameNumber(const std::string& name) {
  constexpr std::string_view kPrefix = "frame-";
  constexpr std::string_view kSuffix = ".pose.txt";
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  return parseFrameNumber(
      std::string_view(name).substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size()));
}

/// Files without a pose (the tracker that wrote them was lost) are left out; files that are something else
/// are an error.
Result<Trajectory> readPoseFiles(const std::vector<fs::path>& files) {
  Trajectory poses;
  for (const fs::path& path : files) {
    const Result<Eigen::Matrix4d> matrix = readMatrixFile(path);
    if (!matrix) return fail(matrix.error());
    if (const auto pose = rigidMotion(*matrix))
      poses.push_back({*frameNumber(path.filename().string()) / kFrameRateHz, *pose});
  }
  return poses;
}

Result<Trajectory> readFolder(const fs::path& folder) {
  for (const char* name : {"groundtruth.txt", "trajectory.txt", "trajectory.log"}) {
    if (fs::exists(folder / name)) return readFile(folder / name);
  }
  std::vector<fs::path> pose_files;
  std::optional<fs::path> log_below;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (frameNumber(entry.path().filename().string())) pose_files.push_back(entry.path());
    if (entry.is_directory() && fs::exists(entry.path() / "trajectory.log"))
      log_below = entry.path() / "trajectory.log";
  }
  if (!pose_files.empty()) return readPoseFiles(pose_files);
  if (log_below) return readFile(*log_below);
  return fail("There are no poses in " + folder.string() + ".",
              "Looked for groundtruth.txt, trajectory.txt, trajectory.log and frame-NNNNNN.pose.txt.");
}

}  // namespace

Result<Trajectory> readTrajectory(const fs::path& path) {
  try {
    if (!fs::exists(path)) return fail(path.string() + " does not exist.", "Check the path.");
    auto poses = fs::is_directory(path) ? readFolder(path) : readFile(path);
    if (!poses) return poses;
    std::stable_sort(poses->begin(), poses->end(), [](const StampedPose& a, const StampedPose& b) {
      return a.timestamp_s < b.timestamp_s;
    });
    return poses;
  } catch (const fs::filesystem_error& error) {
    return fail("Cannot read " + path.string() + ": " + error.code().message() + ".");
  }
}

}  // namespace scantrove
