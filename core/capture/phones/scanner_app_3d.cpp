#include "core/capture/phones/scanner_app_3d.h"

#include <algorithm>
#include <set>

#include "core/base/stamped_pose.h"
#include "core/base/text.h"
#include "core/capture/folder_listing.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"

namespace scantrove {

namespace {

/// `intrinsics` refer to the sensor's images.
constexpr int kSensorWidth = 1920, kSensorHeight = 1440;
constexpr std::string_view kFramePrefix = "frame_", kFrameEnd = ".json";

/// The digits of frame_00012.json.
std::optional<std::string> digitsOfFrame(const std::string& name) {
  if (!name.starts_with(kFramePrefix) || !name.ends_with(kFrameEnd) ||
      name.size() <= kFramePrefix.size() + kFrameEnd.size())
    return std::nullopt;
  std::string digits = name.substr(kFramePrefix.size(), name.size() - kFramePrefix.size() - kFrameEnd.size());
  return parseFrameNumber(digits) ? std::optional(digits) : std::nullopt;
}

Result<ImageSequenceEntry> readFrame(const std::filesystem::path& folder, const std::string& digits) {
  const auto json = readJson(folder / ("frame_" + digits + ".json"));
  if (!json) return fail(json.error());
  ImageSequenceEntry entry;
  entry.index = *parseFrameNumber(digits);
  entry.timestamp_s = numberOf(*json, "time").value_or(entry.index / kFrameRateHz);
  if (const auto matrix = numbersOf(*json, "intrinsics", 9))
    entry.intrinsics = intrinsicsFromRows(*matrix, kSensorWidth, kSensorHeight);
  if (const auto matrix = numbersOf(*json, "cameraPoseARFrame", 16))
    entry.T_world_camera = fromArkitAxes(poseFromRows(*matrix));
  return entry;
}

}  // namespace

bool isScannerApp3dFolder(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto frame =
      std::ranges::find_if(names, [](const std::string& name) { return digitsOfFrame(name).has_value(); });
  if (frame == names.end()) return false;
  const auto json = readJson(folder / *frame);
  return json && json->is_object() && json->contains("cameraPoseARFrame") && json->contains("intrinsics");
}

Result<ImageSequence> readScannerApp3dFolder(const std::filesystem::path& folder,
                                             const std::vector<std::string>& names) {
  const std::set<std::string> present(names.begin(), names.end());
  const auto find = [&](const std::string& name) {
    return present.contains(name) ? folder / name : std::filesystem::path();
  };
  ImageSequence sequence;
  sequence.kind = "3D Scanner App";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = "the frames of " + folder.string();
  UnusableFrames unusable;
  for (const std::string& name : names) {
    const auto digits = digitsOfFrame(name);
    if (!digits || !present.contains("depth_" + *digits + ".png")) continue;
    auto entry = readFrame(folder, *digits);
    if (!entry) {
      unusable.add(entry.error().what);
      continue;
    }
    entry->depth = find("depth_" + *digits + ".png");
    entry->confidence = find("conf_" + *digits + ".png");
    entry->color = find("frame_" + *digits + ".jpg");
    if (entry->intrinsics) sequence.entries.push_back(std::move(*entry));
  }
  unusable.warn(folderName(folder));
  if (sequence.entries.empty())
    return fail(folder.string() + " is a capture of 3D Scanner App without depth images.",
                "Its high-resolution mode stores none: scan in LiDAR mode, and export \"All Data\".");
  return sequence;
}

}  // namespace scantrove
