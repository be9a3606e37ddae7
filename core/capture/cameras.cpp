#include "core/capture/cameras.h"

#include <OpenNI.h>

#include <filesystem>

#include "core/capture/openni_library.h"

namespace scantrove {

Result<std::vector<CameraInfo>> listCameras() {
  SCANTROVE_TRY(initialiseOpenNi());
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<CameraInfo> cameras;
  for (int i = 0; i < devices.getSize(); ++i) {
    const openni::DeviceInfo& device = devices[i];
    // Once opened, the virtual camera and recordings are devices for OpenNI2 too.
    std::error_code error;
    const std::string uri = device.getUri();
    if (uri != "Dummy" && !std::filesystem::is_regular_file(uri, error)) {
      cameras.push_back({uri, device.getName(), device.getVendor()});
    }
  }
  return cameras;
}

std::string cameraAdvice() {
  return "Plug the camera in (its power supply too) and check that `lsusb` shows it, that your user may open "
         "it (a udev rule "
         "for its USB vendor; see README), and that libopenni2-0 with its drivers is installed. OpenNI2's "
         "Linux drivers do not "
         "know the first Kinect (USB 045e:02ae). Without a camera: `camera:Dummy` or `demo`.";
}

}  // namespace scantrove
