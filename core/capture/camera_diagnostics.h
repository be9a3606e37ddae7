#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/known_cameras.h"
#include "core/capture/usb_devices.h"

namespace scantrove {

/// What the doctor found about one depth camera that is plugged in.
struct CameraDiagnosis {
  UsbDevice device;
  KnownCamera camera;
  std::filesystem::path node;  ///< as UsbDevice::node(); of the computer itself, whatever root was looked at
  bool is_served = false;      ///< this build has a driver for it
  bool may_be_opened = false;  ///< by this user: its node can be read and written
  std::vector<Error> problems = {};  ///< what keeps it from working, and the line that helps
  std::vector<Error> remarks = {};   ///< what may

  [[nodiscard]] bool isWell() const { return problems.empty(); }
};

/// Looks at the depth cameras among the USB devices below `root`/sys and at their nodes below `root`/dev:
/// driver, permission, kernel module, USB speed, power supply. Opens nothing. Ends after milliseconds; any
/// thread.
[[nodiscard]] std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root = "/");
/// The same for a build with or without libfreenect, whatever this one is.
[[nodiscard]] std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root,
                                                          bool with_libfreenect);

/// "OpenNI2", "libfreenect", "none".
[[nodiscard]] std::string driverName(CameraDriver driver);

}  // namespace scantrove
