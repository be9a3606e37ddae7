#include "core/capture/foundation_pose_folder.h"

#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"

namespace scantrove {

bool isFoundationPoseFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "cam_K.txt", error) &&
         std::filesystem::is_directory(folder / "rgb", error) &&
         std::filesystem::is_directory(folder / "depth", error);
}

Result<std::unique_ptr<FrameSource>> openFoundationPoseFolder(const std::filesystem::path& folder,
                                                              const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "FoundationPose";
  sequence.folder = folder;
  SCANTROVE_TRY(
      moveInto(sequence.entries, pairFolders(folder / "depth", folder / "rgb", folderName(folder))));
  auto camera = readIntrinsicsMatrix(folder / "cam_K.txt");
  if (!camera && !options.intrinsics) return fail(camera.error());
  if (camera) sequence.camera = *camera;
  sequence.camera_origin = (folder / "cam_K.txt").string();
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
