#include <memory>

#include "app/command.h"
#include "app/json_output.h"
#include "app/kernel_cache_use.h"
#include "core/capture/camera_diagnostics.h"
#include "core/capture/cameras.h"
#include "core/compute/device_choice.h"

namespace scantrove {
namespace {

struct Found {
  std::vector<DeviceInfo> devices;
  Result<std::vector<CameraInfo>> cameras;
  std::vector<CameraDiagnosis> usb;
};

void printDevices(const std::vector<DeviceInfo>& devices) {
  std::cout << "OpenCL devices (--device INDEX|NAME):\n";
  for (const DeviceInfo& device : devices) {
    std::cout << "  [" << device.index << "] " << inLine(device.name) << " (" << inLine(device.platform)
              << ", " << (device.is_gpu ? "GPU" : "CPU") << ", " << device.compute_units << " compute units, "
              << device.memory_mb << " MiB, " << inLine(device.version) << ")\n";
  }
  if (!devices.empty()) return;
  const auto none = chooseDevice("");
  if (!none) std::cout << "  " << none.error().message() << '\n';
}

void printCameras(const Result<std::vector<CameraInfo>>& cameras) {
  std::cout << "Cameras (as SOURCE):\n";
  if (!cameras) {
    std::cout << "  " << inLine(cameras.error().message()) << '\n';
    return;
  }
  for (const CameraInfo& camera : *cameras) {
    std::cout << "  camera:" << inLine(camera.uri) << "  " << inLine(camera.vendor) << ' '
              << inLine(camera.name) << " (" << inLine(camera.driver) << ")\n";
  }
  if (cameras->empty()) std::cout << "  none. Use `camera:Dummy` or `demo` to try without one.\n";
}

/// "045e:02ae Kinect v1 (Xbox 360), bus 1 device 5, 480 Mbit/s, serial number A00..."
void printUsbDevice(const UsbDevice& device, std::string_view name) {
  std::cout << "  " << device.id() << ' ' << name;
  if (device.bus > 0) std::cout << ", bus " << device.bus << " device " << device.number;
  if (device.speed_mbps > 0) std::cout << ", " << device.speed_mbps << " Mbit/s";
  if (!device.serial.empty()) std::cout << ", serial number " << inLine(device.serial);
  std::cout << '\n';
}

void printUsb(const std::vector<CameraDiagnosis>& usb) {
  std::cout << "Depth cameras on USB:\n";
  for (const CameraDiagnosis& found : usb) {
    printUsbDevice(found.device, found.camera.name);
    if (found.isWell()) {
      std::cout << "    driver: " << driverName(found.camera.driver) << "; you have access\n";
    } else if (found.is_served) {
      std::cout << "    driver: " << driverName(found.camera.driver) << '\n';
    }
    for (const Error& problem : found.problems)
      std::cout << "    PROBLEM: " << inLine(problem.message()) << '\n';
    for (const Error& remark : found.remarks) std::cout << "    note: " << inLine(remark.message()) << '\n';
  }
  if (usb.empty()) {
    std::cout
        << "  no known camera. Connect the camera and its power supply, and check that `lsusb` shows it.\n";
  }
}

Json toJson(const std::vector<Error>& errors) {
  Json json = Json::array();
  for (const Error& error : errors) json.push_back({{"what", error.what}, {"advice", error.advice}});
  return json;
}

Json toJson(const CameraDiagnosis& found) {
  return {{"id", found.device.id()},
          {"name", found.camera.name},
          {"manufacturer", found.device.manufacturer},
          {"product", found.device.name},
          {"serial", found.device.serial},
          {"port", found.device.port},
          {"bus", found.device.bus},
          {"device", found.device.number},
          {"speed_mbps", found.device.speed_mbps},
          {"node", found.node.string()},
          {"driver", driverName(found.camera.driver)},
          {"served", found.is_served},
          {"may_open", found.may_be_opened},
          {"modules", found.device.modules},
          {"problems", toJson(found.problems)},
          {"remarks", toJson(found.remarks)}};
}

void printFoundAsJson(const Found& found) {
  Json json = {{"opencl", Json::array()}, {"cameras", Json::array()}, {"usb", Json::array()}};
  for (const DeviceInfo& device : found.devices) {
    json["opencl"].push_back({{"index", device.index},
                              {"name", device.name},
                              {"platform", device.platform},
                              {"version", device.version},
                              {"gpu", device.is_gpu},
                              {"compute_units", device.compute_units},
                              {"memory_mb", device.memory_mb}});
  }
  if (found.cameras) {
    for (const CameraInfo& camera : *found.cameras) {
      json["cameras"].push_back(
          {{"uri", camera.uri}, {"name", camera.name}, {"vendor", camera.vendor}, {"driver", camera.driver}});
    }
  }
  for (const CameraDiagnosis& diagnosis : found.usb) json["usb"].push_back(toJson(diagnosis));
  printJson(json);
}

void printText(const Found& found) {
  printDevices(found.devices);
  printCameras(found.cameras);
  printUsb(found.usb);
}

}  // namespace

void addDevicesCommand(CLI::App& app, CommandJob& job) {
  auto json = std::make_shared<bool>(false);
  auto root = std::make_shared<std::string>("/");
  CLI::App* sub =
      app.add_subcommand("devices", "List OpenCL devices and cameras, and problems that prevent their use");
  sub->add_flag("--json", *json, "as JSON");
  sub->add_option("--root", *root,
                  "read USB devices from DIR/sys and DIR/dev (for a host mounted in a container)")
      ->type_name("DIR");
  sub->callback([json, root, &job] {
    job = [json, root]() -> Result<void> {
      const KernelCacheUse kernels;
      const Found found{listDevices(), listCameras(), examineCameras(*root)};
      *json ? printFoundAsJson(found) : printText(found);
      return {};
    };
  });
}

}  // namespace scantrove
