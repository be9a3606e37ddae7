#include "core/capture/live/realsense_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/color_registration.h"
#include "core/capture/known_cameras.h"
#include "core/capture/live/realsense_camera.h"
#include "core/capture/paired_source.h"

namespace scantrove {

namespace {

using Device = RealsenseCamera::Device;

constexpr double kMillimeter = 1e-3, kTenthOfMillimeter = 1e-4;

std::vector<Device> connectedRealsense(const std::filesystem::path& root) {
  std::vector<Device> devices;
  for (const UsbDevice& usb : readUsbDevices(root)) {
    const auto known = findKnownCamera(usb.vendor, usb.product);
    if (!known || known->driver != CameraDriver::v4l2) continue;
    devices.push_back({usb, std::string(known->name), videoNodesOf(usb, root), {}});
  }
  return devices;
}

Result<Device> chooseRealsense(std::vector<Device> devices, const std::string& uri) {
  const std::size_t colon = uri.find(':');
  const std::string which = colon == std::string::npos ? "" : uri.substr(colon + 1);
  const auto isChosen = [&](const Device& device) {
    return which.empty() || device.usb.serial == which ||
           std::ranges::any_of(device.nodes, [&](const VideoNode& node) { return node.name == which; });
  };
  const auto chosen = std::ranges::find_if(devices, isChosen);
  if (chosen == devices.end()) {
    return fail(which.empty() ? "No RealSense D4xx was found." : "No RealSense D4xx is " + which + ".",
                "Plug it into a USB 3 port; `scantrove devices` lists cameras with their serial numbers.");
  }
  if (which.starts_with('/')) chosen->depth_node = which;
  return std::move(*chosen);
}

Intrinsics depthCameraOf(const RealsenseCamera& camera, const Device& device, const SourceOptions& options) {
  const cv::Size size = camera.depthSize();
  if (options.intrinsics) {
    Intrinsics K = *options.intrinsics;
    K.width = size.width;
    K.height = size.height;
    return K;
  }
  const auto own = camera.depthIntrinsics();
  if (own) return *own;
  const Intrinsics usual = nominalRealsenseIntrinsics(device.usb.product, size);
  spdlog::warn(
      "{}: {} Using the usual {},{},{},{} of its model at {}x{}. Give the right intrinsics with --intrinsics "
      "fx,fy,cx,cy.",
      device.name(), own.error().what, usual.fx, usual.fy, usual.cx, usual.cy, size.width, size.height);
  return usual;
}

/// The colour camera: the user's, else the device's own, whose lens is then undistorted. Without one the
/// camera goes on with depth only.
Result<std::optional<ColorCamera>> colorCameraOf(RealsenseCamera& camera, const Intrinsics& depth_K,
                                                 const std::string& name, const SourceOptions& options) {
  if (!camera.hasColor()) {
    spdlog::warn("{} has no colour images (YUYV). Going on without colour.", name);
    return fail(name + " has no colour images.");
  }
  if (options.color_registration)
    return colorCameraFor(*options.color_registration, camera.colorSize(), depth_K, name);
  const auto own = camera.colorCamera();
  if (!own) {
    spdlog::warn(
        "{}: its colour camera is unknown. {} Going on without colour; --color-registration gives it.", name,
        own.error().what);
    camera.dropColor();
    return fail(own.error());
  }
  camera.undistortColor(own->lens, own->camera.K);
  return std::optional(own->camera);
}

}  // namespace

std::vector<CameraInfo> listRealsenseCameras(const std::filesystem::path& root) {
  std::vector<CameraInfo> cameras;
  for (const Device& device : connectedRealsense(root)) {
    if (device.nodes.empty()) continue;
    const std::string which = device.usb.serial.empty() ? device.nodes.front().name : device.usb.serial;
    cameras.push_back({"realsense:" + which, device.model, "Intel", "V4L2"});
  }
  return cameras;
}

Result<std::unique_ptr<FrameSource>> openRealsenseCamera(const std::string& uri,
                                                         const SourceOptions& options) {
  return openRealsenseCamera(kernelVideoSystem(), "/", uri, options);
}

Result<std::unique_ptr<FrameSource>> openRealsenseCamera(VideoSystem& system,
                                                         const std::filesystem::path& root,
                                                         const std::string& uri,
                                                         const SourceOptions& options) {
  const auto device = chooseRealsense(connectedRealsense(root), uri);
  if (!device) return fail(device.error());
  auto camera = RealsenseCamera::open(system, *device);
  if (!camera) return fail(camera.error());
  PairedSourceSetup setup;
  setup.info.name = device->name();
  setup.info.kind = "RealSense camera";
  setup.info.is_live = true;
  setup.info.intrinsics = depthCameraOf(**camera, *device, options);
  SCANTROVE_TRY(checkIntrinsics(setup.info.intrinsics, "--intrinsics"));
  setup.color_camera = colorCameraOf(**camera, setup.info.intrinsics, setup.info.name, options);
  if (!setup.color_camera && options.color_registration && (*camera)->hasColor())
    return fail(setup.color_camera.error());
  const bool is_d405 = isRealsenseD405(device->usb.product);
  setup.meters_per_unit = options.depth_scale ? 1.0 / *options.depth_scale
                          : is_d405           ? kTenthOfMillimeter
                                              : kMillimeter;
  SCANTROVE_TRY((*camera)->start());
  return std::make_unique<PairedSource>(std::move(*camera), std::move(setup), options);
}

}  // namespace scantrove
