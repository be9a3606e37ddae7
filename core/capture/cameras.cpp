#include "core/capture/cameras.h"

#include <OpenNI.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/capture/freenect_source.h"
#include "core/capture/live/live_cameras.h"
#include "core/capture/openni_library.h"
#include "core/capture/openni_source.h"

namespace scantrove {

namespace {

Result<std::vector<CameraInfo>> listOpenNiCameras() {
  SCANTROVE_TRY(initializeOpenNi());
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<CameraInfo> cameras;
  for (int i = 0; i < devices.getSize(); ++i) {
    const openni::DeviceInfo& device = devices[i];
    // OpenNI2 also lists the virtual camera and recordings as devices once they were opened.
    std::error_code error;
    const std::string uri = device.getUri();
    if (uri != "Dummy" && !std::filesystem::is_regular_file(uri, error)) {
      cameras.push_back({uri, device.getName(), device.getVendor()});
    }
  }
  return cameras;
}

}  // namespace

Result<std::vector<CameraInfo>> listCameras() {
  auto cameras = listOpenNiCameras();
  std::vector<CameraInfo> others = listFreenectCameras().value_or(std::vector<CameraInfo>());
  std::ranges::move(listLiveCameras(), std::back_inserter(others));
  if (others.empty()) {
    return cameras;
  }
  if (!cameras) {
    return others;
  }
  std::ranges::move(others, std::back_inserter(*cameras));
  return cameras;
}

Result<std::unique_ptr<FrameSource>> openCamera(const std::string& uri, const SourceOptions& options) {
  std::string chosen = uri;
  if (chosen.empty()) {
    const auto cameras = listCameras();
    if (!cameras) {
      return fail(cameras.error());
    }
    if (cameras->empty()) {
      return fail("No depth camera was found.", cameraAdvice());
    }
    chosen = cameras->front().uri;
  }
  if (isLiveCameraUri(chosen)) return openLiveCamera(chosen, options);
  return isFreenectUri(chosen) ? openFreenectCamera(chosen, options) : openOpenNiCamera(chosen, options);
}

std::string cameraAdvice() {
  return "Plug the camera in, its power supply too; `scantrove devices` then says what is plugged in, which "
         "driver serves it, and the line that helps where your user may not open it (a udev rule). OpenNI2 "
         "serves PrimeSense cameras (Asus Xtion, Carmine), libfreenect the first Kinect (USB 045e:02ae), the "
         "kernel RealSense D400 cameras, usbmuxd an iPhone that streams with Record3D. "
         "Without a camera: `camera:Dummy` or `demo`.";
}

}  // namespace scantrove
