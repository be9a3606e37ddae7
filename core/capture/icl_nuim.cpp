#include "core/capture/icl_nuim.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"

namespace scantrove {
namespace {

/// The data set gives fy = -480.
constexpr Intrinsics kIclNuimCamera{481.2F, 480, 319.5F, 239.5F, 640, 480};
constexpr double kIclNuimUnitsPerMeter = 5000;
constexpr const char* kIclNuimPoses = ".gt.freiburg";

bool hasIclName(const std::vector<std::string>& names, const char* name) {
  return std::ranges::find(names, name) != names.end();
}

/// Whether the first line is `N depth/N.png N rgb/N.png`.
bool hasFrameNumbers(const std::filesystem::path& associations) {
  const auto text = readTextFile(associations);
  if (!text) return false;
  for (const std::string_view line : splitLines(*text)) {
    if (trimmed(line).empty() || line.front() == '#') continue;
    const std::size_t blank = line.find(' ');
    const auto number = parseFrameNumber(line.substr(0, blank));
    const std::string expected = "depth/" + std::string(line.substr(0, blank)) + ".";
    return number && line.substr(blank + 1).starts_with(expected);
  }
  return false;
}

/// Reverses the y axes of camera and world.
Eigen::Isometry3d mirroredPose(const Eigen::Isometry3d& pose) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  Eigen::Isometry3d mirrored = Eigen::Isometry3d::Identity();
  mirrored.linear() = mirror * pose.linear() * mirror;
  mirrored.translation() = mirror * pose.translation();
  return mirrored;
}

/// Returns whether poses are to be mirrored.
Result<bool> chooseIclCamera(ImageSequence& sequence, const SourceOptions& options) {
  auto camera = findIntrinsics(sequence.folder);
  if (!camera && !options.intrinsics) return fail(camera.error());
  if (!camera || !*camera) {
    sequence.camera = CameraModel{kIclNuimCamera, std::nullopt};
    sequence.camera_origin = "ICL-NUIM's own";
    return true;
  }
  sequence.camera = **camera;
  sequence.camera_origin = "from the file of " + sequence.folder.string();
  const bool is_mirrored = sequence.camera.K.fy < 0;
  sequence.camera.K.fy = std::abs(sequence.camera.K.fy);
  return is_mirrored;
}

Result<void> addIclPoses(ImageSequence& sequence, const std::filesystem::path& file, bool is_mirrored) {
  const auto poses = readIclNuimPoses(file, is_mirrored);
  if (!poses) return fail(poses.error());
  std::map<int, Eigen::Isometry3d> by_number;
  for (const NumberedPose& pose : *poses) by_number.emplace(pose.number, pose.T_world_camera);
  for (ImageSequenceEntry& entry : sequence.entries) {
    const auto pose = by_number.find(entry.index);
    if (pose != by_number.end()) entry.T_world_camera = pose->second;
    sequence.has_poses = sequence.has_poses || entry.T_world_camera;
  }
  return {};
}

}  // namespace

std::optional<std::string> iclNuimPoseFile(const std::vector<std::string>& names) {
  const auto found =
      std::ranges::find_if(names, [](const std::string& name) { return name.ends_with(kIclNuimPoses); });
  return found == names.end() ? std::nullopt : std::optional(*found);
}

bool isIclNuimFolder(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  if (!hasIclName(names, "depth") || !hasIclName(names, "rgb")) return false;
  if (iclNuimPoseFile(names)) return true;
  return hasIclName(names, "associations.txt") && !hasIclName(names, "depth.txt") &&
         hasFrameNumbers(folder / "associations.txt");
}

Result<std::vector<NumberedPose>> readIclNuimPoses(const std::filesystem::path& file, bool is_mirrored) {
  const auto trajectory = readTumTrajectory(file);
  if (!trajectory) return fail(trajectory.error());
  constexpr double kLargestNumber = 1e9;
  std::vector<NumberedPose> poses;
  for (const StampedPose& pose : *trajectory) {
    if (!(pose.timestamp_s >= 0 && pose.timestamp_s < kLargestNumber)) continue;
    poses.push_back({static_cast<int>(std::lround(pose.timestamp_s)),
                     is_mirrored ? mirroredPose(pose.T_world_camera) : pose.T_world_camera});
  }
  return poses;
}

Result<std::unique_ptr<FrameSource>> openIclNuimFolder(const std::filesystem::path& folder,
                                                       const std::vector<std::string>& names,
                                                       const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "ICL-NUIM";
  sequence.folder = folder;
  sequence.units_per_meter = kIclNuimUnitsPerMeter;
  SCANTROVE_TRY(
      moveInto(sequence.entries, pairFolders(folder / "depth", folder / "rgb", folderName(folder))));
  bool is_mirrored = false;
  SCANTROVE_TRY(moveInto(is_mirrored, chooseIclCamera(sequence, options)));
  const std::string poses = iclNuimPoseFile(names).value_or("groundtruth.txt");
  if (hasIclName(names, poses.c_str())) SCANTROVE_TRY(addIclPoses(sequence, folder / poses, is_mirrored));
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
