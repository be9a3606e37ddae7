#include "core/capture/reopened_camera.h"

#include <string_view>
#include <utility>

#include "core/capture/cameras.h"
#include "core/capture/open_input.h"

namespace scantrove {
namespace {

constexpr std::string_view kCameraPrefix = "camera:";

}  // namespace

std::string sameModel(const std::string& uri, const std::vector<CameraInfo>& cameras) {
  const std::size_t place = uri.find('@');
  if (place == std::string::npos) return {};
  const std::string_view model(uri.data(), place + 1);
  std::string found;
  for (const CameraInfo& camera : cameras) {
    if (!camera.uri.starts_with(model)) continue;
    if (!found.empty()) return {};
    found = camera.uri;
  }
  return found;
}

Result<std::unique_ptr<FrameSource>> reopenCamera(const std::string& source, const SourceOptions& options) {
  SourceOptions again = options;
  again.start = 0;  // frames were skipped when it was opened first
  again.on_opening = {};
  Result<std::unique_ptr<FrameSource>> opened = openInput(source, again);
  if (opened || !source.starts_with(kCameraPrefix)) return opened;
  const auto cameras = listCameras();
  if (!cameras) return opened;
  const std::string uri = sameModel(source.substr(kCameraPrefix.size()), *cameras);
  return uri.empty() ? std::move(opened) : openCamera(uri, again);
}

}  // namespace scantrove
