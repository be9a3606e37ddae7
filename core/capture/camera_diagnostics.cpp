#include "core/capture/camera_diagnostics.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/capture/device_access.h"
#include "core/capture/freenect_source.h"
#include "core/capture/live/video_nodes.h"

namespace scantrove {

namespace {

using Part = KnownCamera::Part;

bool isServed(CameraDriver driver, bool with_libfreenect) {
  return driver == CameraDriver::openni2 || driver == CameraDriver::v4l2 ||
         (driver == CameraDriver::libfreenect && with_libfreenect);
}

Error withoutDriver(const KnownCamera& camera) {
  if (camera.driver == CameraDriver::libfreenect) {
    return {"This Scantrove was built without libfreenect.",
            "Install it and build again: `sudo apt-get install libfreenect-dev`"};
  }
  return {"Debian 12 has no driver for it.", std::string(camera.advice)};
}

/// Checks that the user may read and write `node` of `subsystem`, displayed as `name`.
std::optional<Error> lacksPermission(const UsbDevice& device, const std::filesystem::path& node,
                                     const std::string& name, std::string_view subsystem) {
  if (node.empty()) {
    return Error{"The kernel does not say where it is (/sys/bus/usb/devices/" + device.port + ").",
                 "Plug it in again."};
  }
  if (access(node.c_str(), R_OK | W_OK) == 0) {
    return std::nullopt;
  }
  if (errno == ENOENT) {
    return Error{"There is no " + name + ".",
                 "In a container: give it the devices, for example `docker run --device /dev/bus/usb`."};
  }
  return Error{"Your user may not open " + name + ": " + std::strerror(errno) + ".",
               accessAdvice(device, node, subsystem)};
}

/// The same for the nodes through which the kernel drives the camera.
std::optional<Error> lacksVideoPermission(const UsbDevice& device, const std::filesystem::path& root) {
  const auto nodes = videoNodesOf(device, root);
  if (nodes.empty())
    return Error{"The kernel has no video node for it.", "Load its driver: `sudo modprobe uvcvideo`."};
  for (const VideoNode& node : nodes) {
    if (auto lacking = lacksPermission(device, node.path, node.name, "video4linux")) return lacking;
  }
  return std::nullopt;
}

std::string formatted(double speed_mbps) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", speed_mbps);
  return text;
}

std::optional<Error> isSlow(const UsbDevice& device, const KnownCamera& camera) {
  if (device.speed_mbps <= 0 || device.speed_mbps >= camera.needed_mbps) {
    return std::nullopt;
  }
  return Error{"It is connected at " + formatted(device.speed_mbps) + " Mbit/s and needs " +
                   formatted(camera.needed_mbps) + ".",
               std::string("Plug it into a ") + (camera.needed_mbps > 480 ? "USB 3" : "USB 2 or 3") +
                   " port of the computer itself, with another cable."};
}

/// The kernel's video module claims every connected Kinect v1. libfreenect reclaims it on opening, with
/// permission.
std::optional<Error> isHeldByModule(const UsbDevice& device, const KnownCamera& camera) {
  const auto holds = [&](const char* module) { return std::ranges::count(device.modules, module) > 0; };
  // A built-in module shows only as its driver, "kinect".
  if (camera.driver != CameraDriver::libfreenect || (!holds("gspca_kinect") && !holds("kinect"))) {
    return std::nullopt;
  }
  return Error{
      "The kernel module gspca_kinect holds it.",
      "If it does not open: `sudo modprobe -r gspca_kinect`; for good: `echo 'blacklist gspca_kinect' | "
      "sudo tee /etc/modprobe.d/blacklist-gspca-kinect.conf`"};
}

CameraDiagnosis examine(const UsbDevice& device, const KnownCamera& camera, const std::filesystem::path& root,
                        bool with_libfreenect) {
  CameraDiagnosis diagnosis{.device = device, .camera = camera, .node = device.node("/")};
  const auto add = [](std::vector<Error>& to, std::optional<Error> found) {
    if (found) {
      to.push_back(std::move(*found));
    }
  };
  diagnosis.is_served = isServed(camera.driver, with_libfreenect);
  std::optional<Error> permission =
      camera.driver == CameraDriver::v4l2
          ? lacksVideoPermission(device, root)
          : lacksPermission(device, device.node(root), diagnosis.node.string(), "usb");
  diagnosis.may_be_opened = !permission;
  if (diagnosis.is_served) {
    add(diagnosis.problems, std::move(permission));
  } else {
    diagnosis.problems.push_back(withoutDriver(camera));
  }
  add(diagnosis.problems, isSlow(device, camera));
  add(diagnosis.remarks, isHeldByModule(device, camera));
  return diagnosis;
}

}  // namespace

std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root) {
  return examineCameras(root, hasFreenect());
}

std::vector<CameraDiagnosis> examineCameras(const std::filesystem::path& root, bool with_libfreenect) {
  std::vector<CameraDiagnosis> diagnoses;
  int kinects = 0;
  std::vector<std::pair<UsbDevice, KnownCamera>> motors;
  for (const UsbDevice& device : readUsbDevices(root)) {
    const auto camera = findKnownCamera(device.vendor, device.product);
    if (!camera || camera->part == Part::other) {
      continue;
    }
    if (camera->part == Part::motor) {
      motors.emplace_back(device, *camera);
      continue;
    }
    kinects += camera->driver == CameraDriver::libfreenect ? 1 : 0;
    diagnoses.push_back(examine(device, *camera, root, with_libfreenect));
  }
  if (kinects == 0) {
    for (const auto& [device, motor] : motors) {
      diagnoses.push_back({.device = device, .camera = motor, .node = device.node("/")});
      diagnoses.back().problems.push_back(
          {"A Kinect v1 is plugged in, but only its motor answers.",
           "Connect its power supply: the camera has no power from USB. Then plug it in again."});
    }
  }
  return diagnoses;
}

std::string driverName(CameraDriver driver) {
  switch (driver) {
    case CameraDriver::openni2:
      return "OpenNI2";
    case CameraDriver::libfreenect:
      return "libfreenect";
    case CameraDriver::v4l2:
      return "V4L2";
    case CameraDriver::none:
      break;
  }
  return "none";
}

}  // namespace scantrove
