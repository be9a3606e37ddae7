#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/known_cameras.h"
#include "core/capture/usb_devices.h"

namespace scantrove {

/// Diagnosis of one connected depth camera.
struct CameraDiagnosis {
  UsbDevice device;
  KnownCamera camera;
  std::filesystem::path node;  ///< as UsbDevice::node(), on this computer even when `root` is another folder
  bool is_served = false;      ///< this build has a driver for it
  bool may_be_opened = false;  ///< this user can read and write its node
  std::vector<Error> problems = {};  ///< they prevent the camera from working; the advice helps
  std::vector<Error> remarks = {};   ///< they may prevent it from working

  [[nodiscard]] bool isWell() const { return problems.empty(); }
};

/// Examines depth cameras among the USB devices below `root`/sys and their nodes below `root`/dev: driver,
/// permission, kernel module, USB speed, power supply. Opens no device. Takes milliseconds; any thread.
[[nodiscard]] std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root = "/");
/// The same for a build with or without libfreenect, independent of this build.
[[nodiscard]] std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root,
                                                          bool with_libfreenect);

/// "OpenNI2", "libfreenect", "V4L2", "none".
[[nodiscard]] std::string driverName(CameraDriver driver);

}  // namespace scantrove
