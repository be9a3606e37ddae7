#include "core/capture/scenenn_folder.h"

#include "core/capture/data_set_camera.h"
#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"
#include "core/capture/recorded_poses.h"

namespace scantrove {
namespace {

/// asus.ini of the data set. Its Kinect v2 has images of another size.
constexpr Intrinsics kSceneNnXtion{544.47329F, 544.47329F, 320, 240, 640, 480};

}  // namespace

bool isSceneNnFolder(const std::filesystem::path& folder) {
  return hasNumberedFiles(folder / "image", "image") && hasNumberedFiles(folder / "depth", "depth");
}

Result<std::unique_ptr<FrameSource>> openSceneNnFolder(const std::filesystem::path& folder,
                                                       const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "SceneNN";
  sequence.folder = folder;
  SCANTROVE_TRY(
      moveInto(sequence.entries, pairFolders(folder / "depth", folder / "image", folderName(folder))));
  SCANTROVE_TRY(chooseDataSetCamera(sequence, kSceneNnXtion, "SceneNN's", options));
  if (const auto log = findTrajectoryLog(folder)) {
    const auto poses = readTrajectoryLog(*log);
    if (!poses) return fail(poses.error());
    sequence.has_poses = !poses->empty();
    addPosesByNumber(sequence, *poses);
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
