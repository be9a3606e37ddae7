#include "core/capture/data_set_camera.h"

#include "core/capture/folder_pairs.h"

namespace scantrove {

Result<void> chooseDataSetCamera(ImageSequence& sequence, const Intrinsics& own, const std::string& own_name,
                                 const SourceOptions& options) {
  auto camera = findIntrinsics(sequence.folder);
  if (!camera && !options.intrinsics) return fail(camera.error());
  if (camera && *camera) {
    sequence.camera = **camera;
    sequence.camera_origin = "from the file of " + sequence.folder.string();
    return {};
  }
  sequence.camera = CameraModel{own, std::nullopt};
  sequence.camera_origin = own_name + " own";
  const auto size = depthSizeOf(sequence.entries);
  const bool is_own = !size || *size == cv::Size(own.width, own.height);
  if (is_own || options.intrinsics) return {};
  return fail(sequence.folder.string() + " has images of " + std::to_string(size->width) + "x" +
                  std::to_string(size->height) + "; " + own_name + " camera is known for " +
                  std::to_string(own.width) + "x" + std::to_string(own.height) + " only.",
              "Give --intrinsics fx,fy,cx,cy.");
}

}  // namespace scantrove
