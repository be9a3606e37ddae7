#include "core/capture/seven_scenes.h"

#include <algorithm>
#include <map>

#include "core/base/stamped_pose.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

namespace {

/// The data set's README says 585 pixels for depth and that colour was not calibrated. 525 is the focal
/// length that Kinect drivers give for colour, 25 mm the distance of its two lenses; against the outlines of
/// mugs and chairs in the kitchen this is right to a few pixels. Another camera: SourceOptions::color_camera.
constexpr ColorCamera kSevenScenesColorCamera{525.0F, 525.0F, 320.0F, 240.0F, -0.025F};

}  // namespace

bool isSevenScenesFolder(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    const auto part = sevenScenesPart(name);
    return part && part->suffix == "depth.png";
  });
}

Result<std::unique_ptr<FrameSource>> openSevenScenes(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& names,
                                                     const SourceOptions& options) {
  constexpr Intrinsics kDefault{585, 585, 320, 240, 640, 480};
  ImageSequence sequence;
  sequence.kind = "7-Scenes";
  sequence.folder = folder;
  sequence.has_color = false;
  std::map<int, ImageSequenceEntry> entries;
  for (const std::string& name : names) {
    const auto part = sevenScenesPart(name);
    if (!part) {
      continue;
    }
    if (part->suffix == "depth.png") {
      entries[part->number].depth = folder / name;
    } else if (part->suffix == "pose.txt") {
      entries[part->number].pose_file = folder / name;
      sequence.has_poses = true;
    } else if (part->suffix == "color.jpg" || part->suffix == "color.jpeg" || part->suffix == "color.png") {
      entries[part->number].color = folder / name;
      sequence.has_color = true;
    }
  }
  for (auto& [number, entry] : entries) {
    if (entry.depth.empty() && entry.color.empty()) {
      continue;  // a pose alone is no frame
    }
    entry.index = number;
    entry.timestamp_s = number / kFrameRateHz;
    sequence.entries.push_back(std::move(entry));
  }
  auto camera = findIntrinsics(folder);
  if (!camera && !options.intrinsics) {
    return fail(camera.error());
  }
  const bool is_known = camera && *camera;
  sequence.camera = is_known ? **camera : CameraModel{kDefault, std::nullopt};
  sequence.camera_origin = is_known ? (folder / "camera-intrinsics.txt").string() : "7-Scenes' own";
  // The data set's own depth camera; folders in the same layout from other cameras are taken as registered.
  Intrinsics K = sequence.camera.K;
  K.width = kDefault.width;
  K.height = kDefault.height;
  if (K == kDefault && !options.intrinsics && !sequence.camera.color_is_registered) {
    sequence.color_camera = kSevenScenesColorCamera;
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
