#include "core/capture/numbered_folder.h"

#include <spdlog/spdlog.h>

#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/recorded_poses.h"

namespace scantrove {

namespace {

std::optional<std::filesystem::path> findColorFolder(const std::filesystem::path& folder) {
  for (const char* const name : {"color", "image", "rgb"}) {
    std::error_code error;
    if (std::filesystem::is_directory(folder / name, error)) {
      return folder / name;
    }
  }
  return std::nullopt;
}

}  // namespace

bool isNumberedFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder / "depth", error);
}

Result<std::unique_ptr<FrameSource>> openNumberedFolder(const std::filesystem::path& folder,
                                                        const SourceOptions& options) {
  const auto color_folder = findColorFolder(folder);
  auto entries = pairFolders(folder / "depth", color_folder, folderName(folder));
  if (!entries) {
    return fail(entries.error());
  }
  ImageSequence sequence;
  sequence.kind = "numbered images";
  sequence.folder = folder;
  sequence.entries = std::move(*entries);
  sequence.has_color = color_folder.has_value();
  auto camera = findIntrinsics(folder);
  if (!camera && !options.intrinsics) {
    return fail(camera.error());
  }
  if (camera && *camera) {
    sequence.camera = **camera;
    sequence.camera_origin = "from the file in " + folder.string();
  } else {
    sequence.camera = CameraModel{kPrimeSenseIntrinsics, std::nullopt};
    sequence.camera_origin = "default";
    if (!options.intrinsics) {
      spdlog::warn(
          "{}: no intrinsics given and none found (camera-intrinsics.txt, intrinsic.json, "
          "camera_intrinsic.json, cam_K.txt, intrinsic/intrinsic_depth.txt); "
          "using 525,525,319.5,239.5 at 640x480. Give the right ones with --intrinsics fx,fy,cx,cy.",
          folderName(folder));
    }
  }
  if (const auto log = findTrajectoryLog(folder)) {
    const auto poses = readTrajectoryLog(*log);
    if (!poses) {
      return fail(poses.error());
    }
    sequence.has_poses = !poses->empty();
    addPosesByNumber(sequence, *poses);
  } else {
    addPoseFiles(sequence, folder / "pose");
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
