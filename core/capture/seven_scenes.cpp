#include "core/capture/seven_scenes.h"

#include <algorithm>
#include <map>

#include "core/base/stamped_pose.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/rig_info.h"

namespace scantrove {

namespace {

constexpr Intrinsics kOwnIntrinsics{585, 585, 320, 240, 640, 480};

/// The data set's README gives 585 pixels for depth and no colour calibration. These values align depth
/// outlines with edges of the colour images. Measured on 71 frames of the kitchen (180,000 outline pixels):
/// 0.7 pixels off on average over ninths of the image, near and far, 1.3 at most (kinectColorCamera(): 2.6
/// and 4.7; as registered: 16 and 53).
ColorCamera ownColorCamera() {
  ColorCamera camera{{527, 527, 320.5F, 238, 640, 480}};
  camera.T_color_depth =
      Eigen::Translation3d(-0.026, 0, 0) * Eigen::AngleAxisd(0.0075, Eigen::Vector3d::UnitZ());
  return camera;
}

/// Whether the intrinsics are the data set's own depth camera's, at any image size.
bool isOwnCamera(Intrinsics K) {
  K.width = kOwnIntrinsics.width;
  K.height = kOwnIntrinsics.height;
  return K == kOwnIntrinsics;
}

/// PGM: 3RScan.
bool isDepthSuffix(std::string_view suffix) { return suffix == "depth.png" || suffix == "depth.pgm"; }

/// The camera of a file in the folder, else the data set's own.
Result<void> chooseKinect(ImageSequence& sequence, const SourceOptions& options) {
  if (const auto info = findRigInfo(sequence.folder)) {
    auto model = readRigInfo(*info);
    if (!model && !options.intrinsics) return fail(model.error());
    sequence.kind = info->filename() == "info.txt" ? "BundleFusion" : "3RScan";
    sequence.camera = model.value_or(CameraModel{kOwnIntrinsics, std::nullopt});
    sequence.camera_origin = info->string();
    return {};
  }
  auto camera = findIntrinsics(sequence.folder);
  if (!camera && !options.intrinsics) return fail(camera.error());
  const bool is_known = camera && *camera;
  sequence.camera = is_known ? **camera : CameraModel{kOwnIntrinsics, std::nullopt};
  sequence.camera_origin = is_known ? (sequence.folder / "camera-intrinsics.txt").string() : "7-Scenes' own";
  // Folders of other cameras in the same layout count as registered.
  const bool is_given = !is_known && options.intrinsics;
  if (isOwnCamera(is_given ? *options.intrinsics : sequence.camera.K)) {
    sequence.color.camera = ownColorCamera();
  }
  return {};
}

}  // namespace

bool isSevenScenesFolder(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    const auto part = sevenScenesPart(name);
    return part && isDepthSuffix(part->suffix);
  });
}

Result<std::unique_ptr<FrameSource>> openSevenScenes(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& names,
                                                     const SourceOptions& options) {
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
    if (isDepthSuffix(part->suffix)) {
      entries[part->number].depth = folder / name;
    } else if (part->suffix == "pose.txt") {
      entries[part->number].pose_file = folder / name;
      sequence.has_poses = true;
    } else if (part->suffix == "intrinsics.txt") {
      entries[part->number].intrinsics_file = folder / name;
    } else if (part->suffix == "color.jpg" || part->suffix == "color.jpeg" || part->suffix == "color.png") {
      entries[part->number].color = folder / name;
      sequence.has_color = true;
    }
  }
  for (auto& [number, entry] : entries) {
    if (entry.depth.empty() && entry.color.empty()) {
      continue;  // a pose without images is no frame
    }
    entry.index = number;
    entry.timestamp_s = number / kFrameRateHz;
    sequence.entries.push_back(std::move(entry));
  }
  SCANTROVE_TRY(chooseKinect(sequence, options));
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
