#include "core/capture/live/live_cameras.h"

#include <algorithm>
#include <iterator>

#include "core/capture/live/realsense_source.h"
#include "core/capture/live/record3d_stream.h"

namespace scantrove {

bool isLiveCameraUri(std::string_view uri) { return isRealsenseUri(uri) || isRecord3dUri(uri); }

std::vector<CameraInfo> listLiveCameras() {
  std::vector<CameraInfo> cameras = listRealsenseCameras();
  std::ranges::move(listRecord3dPhones(), std::back_inserter(cameras));
  return cameras;
}

Result<std::unique_ptr<FrameSource>> openLiveCamera(const std::string& uri, const SourceOptions& options) {
  return isRealsenseUri(uri) ? openRealsenseCamera(uri, options) : openRecord3dPhone(uri, options);
}

}  // namespace scantrove
