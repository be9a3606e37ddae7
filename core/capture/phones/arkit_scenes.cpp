#include "core/capture/phones/arkit_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/base/stamped_pose.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/recorded_poses.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

constexpr const char* kTrajectoryName = "lowres_wide.traj";

/// Files by their time in milliseconds; names of one frame may differ by one.
using FilesByTime = std::map<std::int64_t, std::filesystem::path>;

/// The time in a name such as 41069021_402896.975.png, seconds.
std::optional<double> timeInName(const std::string& name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  const std::size_t underline = stem.rfind('_');
  const auto numbers = underline == std::string::npos
                           ? std::nullopt
                           : parseNumbers(std::string_view(stem).substr(underline + 1));
  constexpr double kMaxTime_s = 1e12;
  if (!numbers || numbers->size() != 1 || !(std::abs(numbers->front()) < kMaxTime_s)) return std::nullopt;
  return numbers->front();
}

FilesByTime filesByTime(const std::filesystem::path& folder) {
  FilesByTime files;
  const auto names = listFolder(folder);
  for (const std::string& name : names.value_or(std::vector<std::string>())) {
    if (const auto time = timeInName(name)) files.emplace(std::llround(*time * 1000), folder / name);
  }
  return files;
}

std::filesystem::path fileAt(const FilesByTime& files, std::int64_t time_ms) {
  for (const std::int64_t time : {time_ms, time_ms - 1, time_ms + 1}) {
    if (const auto found = files.find(time); found != files.end()) return found->second;
  }
  return {};
}

/// A .pincam file: width, height, fx, fy, cx, cy.
std::optional<Intrinsics> readPincam(const std::filesystem::path& file) {
  const auto text = file.empty() ? fail("") : readTextFile(file);
  const auto values = text ? parseNumbers(*text) : std::nullopt;
  if (!values || values->size() != 6) return std::nullopt;
  for (const std::size_t side : {0U, 1U}) {
    if (!((*values)[side] >= 1 && (*values)[side] <= kLongestImageSide_px)) return std::nullopt;
  }
  const auto at = [&](std::size_t i) { return static_cast<float>((*values)[i]); };
  return Intrinsics{
      at(2), at(3), at(4), at(5), static_cast<int>((*values)[0]), static_cast<int>((*values)[1])};
}

/// Lines of a time, an axis times its angle, and a translation: the world in the camera.
Result<Trajectory> readArkitTrajectory(const std::filesystem::path& file) {
  const auto text = readTextFile(file);
  if (!text) return fail(text.error());
  Trajectory trajectory;
  int number = 0;
  for (const std::string_view line : splitLines(*text)) {
    ++number;
    if (trimmed(line).empty()) continue;
    const auto values = parseNumbers(line);
    if (!values || values->size() != 7)
      return fail(
          file.string() + ", line " + std::to_string(number) + " is not a time, an axis and a translation.",
          "Download the file again.");
    if (!std::ranges::all_of(*values, [](double value) { return std::isfinite(value); })) continue;
    const Eigen::Vector3d axis((*values)[1], (*values)[2], (*values)[3]);
    if (!std::isfinite(axis.norm())) continue;
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    if (axis.norm() > 0) T_camera_world.linear() = Eigen::AngleAxisd(axis.norm(), axis.normalized()).matrix();
    T_camera_world.translation() = Eigen::Vector3d((*values)[4], (*values)[5], (*values)[6]);
    trajectory.push_back({values->front(), T_camera_world.inverse()});
  }
  std::ranges::stable_sort(trajectory, {}, &StampedPose::timestamp_s);
  return trajectory;
}

std::filesystem::path framesFolder(const std::filesystem::path& folder) {
  const auto isScene = [](const std::filesystem::path& place) {
    return isFolder(place / "lowres_depth") && !fileIfPresent(place / kTrajectoryName).empty();
  };
  if (isScene(folder)) return folder;
  const std::filesystem::path inside = folder / (folderName(folder) + "_frames");
  return isScene(inside) ? inside : std::filesystem::path();
}

}  // namespace

bool isArkitScenesFolder(const std::filesystem::path& folder) { return !framesFolder(folder).empty(); }

Result<ImageSequence> readArkitScenesFolder(const std::filesystem::path& folder) {
  const std::filesystem::path place = framesFolder(folder);
  const auto trajectory = readArkitTrajectory(place / kTrajectoryName);
  if (!trajectory) return fail(trajectory.error());
  const FilesByTime color = filesByTime(place / "lowres_wide"),
                    confidence = filesByTime(place / "confidence"),
                    cameras = filesByTime(place / "lowres_wide_intrinsics");
  ImageSequence sequence;
  sequence.kind = "ARKitScenes";
  sequence.folder = folder;
  sequence.has_poses = !trajectory->empty();
  sequence.is_color_optional = true;
  sequence.camera_origin = (place / "lowres_wide_intrinsics").string();
  UnusableFrames unusable;
  for (const auto& [time_ms, depth] : filesByTime(place / "lowres_depth")) {
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(sequence.entries.size());
    entry.timestamp_s = static_cast<double>(time_ms) / 1000;
    entry.depth = depth;
    entry.color = fileAt(color, time_ms);
    entry.confidence = fileAt(confidence, time_ms);
    entry.intrinsics = readPincam(fileAt(cameras, time_ms));
    entry.T_world_camera = poseAt(*trajectory, entry.timestamp_s);
    if (entry.intrinsics) {
      sequence.entries.push_back(std::move(entry));
    } else {
      unusable.add(depth.string() + " has no .pincam file.");
    }
  }
  unusable.warn(folderName(folder));
  if (sequence.entries.empty())
    return fail(folder.string() + " has no depth image with a file of intrinsics (.pincam).",
                "Download lowres_depth and lowres_wide_intrinsics of this scene.");
  return sequence;
}

}  // namespace scantrove
