#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "core/capture/cameras.h"
#include "core/compute/device_choice.h"

namespace scantrove {
namespace {

using Json = nlohmann::ordered_json;

void printText(const std::vector<DeviceInfo>& devices, const Result<std::vector<CameraInfo>>& cameras) {
  std::cout << "OpenCL devices (--device INDEX|NAME):\n";
  for (const DeviceInfo& device : devices) {
    std::cout << "  [" << device.index << "] " << device.name << " (" << device.platform << ", "
              << (device.is_gpu ? "GPU" : "CPU") << ", " << device.compute_units << " compute units, "
              << device.memory_mb << " MiB, " << device.version << ")\n";
  }
  if (devices.empty()) {
    std::cout
        << "  none. Install the package pocl-opencl-icd (runs on any CPU), or your GPU's OpenCL driver.\n";
  }
  std::cout << "Cameras (as SOURCE):\n";
  if (!cameras) {
    std::cout << "  " << cameras.error().message() << '\n';
    return;
  }
  for (const CameraInfo& camera : *cameras) {
    std::cout << "  camera:" << camera.uri << "  " << camera.vendor << ' ' << camera.name << '\n';
  }
  if (cameras->empty()) std::cout << "  none. " << cameraAdvice() << '\n';
}

void printJson(const std::vector<DeviceInfo>& devices, const Result<std::vector<CameraInfo>>& cameras) {
  Json json = {{"opencl", Json::array()}, {"cameras", Json::array()}};
  for (const DeviceInfo& device : devices) {
    json["opencl"].push_back({{"index", device.index},
                              {"name", device.name},
                              {"platform", device.platform},
                              {"version", device.version},
                              {"gpu", device.is_gpu},
                              {"compute_units", device.compute_units},
                              {"memory_mb", device.memory_mb}});
  }
  if (cameras) {
    for (const CameraInfo& camera : *cameras) {
      json["cameras"].push_back({{"uri", camera.uri}, {"name", camera.name}, {"vendor", camera.vendor}});
    }
  }
  std::cout << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace

void addDevicesCommand(CLI::App& app, CommandOutcome&) {
  auto json = std::make_shared<bool>(false);
  CLI::App* sub = app.add_subcommand("devices", "List OpenCL devices and cameras");
  sub->add_flag("--json", *json, "as JSON");
  sub->callback([json] {
    const auto devices = listDevices();
    const auto cameras = listCameras();
    *json ? printJson(devices, cameras) : printText(devices, cameras);
  });
}

}  // namespace scantrove
