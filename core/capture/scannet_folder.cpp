#include "core/capture/scannet_folder.h"

#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"

namespace scantrove {
namespace {

bool isScannetFile(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

Result<CameraModel> readScannetCamera(const std::filesystem::path& folder) {
  if (isScannetFile(folder / "intrinsic/intrinsic_depth.txt"))
    return readScannetIntrinsics(folder / "intrinsic", "intrinsic");
  return readScannetIntrinsics(folder, "intrinsics");
}

}  // namespace

bool isScannetFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder / "depth", error) &&
         std::filesystem::is_directory(folder / "pose", error) &&
         (isScannetFile(folder / "intrinsic/intrinsic_depth.txt") ||
          isScannetFile(folder / "intrinsics_depth.txt"));
}

Result<std::unique_ptr<FrameSource>> openScannetFolder(const std::filesystem::path& folder,
                                                       const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "ScanNet";
  sequence.folder = folder;
  std::error_code error;
  sequence.has_color = std::filesystem::is_directory(folder / "color", error);
  const auto color_folder = sequence.has_color ? std::optional(folder / "color") : std::nullopt;
  SCANTROVE_TRY(moveInto(sequence.entries, pairFolders(folder / "depth", color_folder, folderName(folder))));
  auto camera = readScannetCamera(folder);
  if (!camera && !options.intrinsics) return fail(camera.error());
  if (camera) sequence.camera = *camera;
  sequence.camera_origin = "from the files of " + folder.string();
  addPoseFiles(sequence, folder / "pose");
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
