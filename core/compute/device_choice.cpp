#include "core/compute/device_choice.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <mutex>

namespace scantrove {
namespace {

// PoCL creates its devices at the first query; concurrent queries see none.
std::vector<cl::Device> allDevices() {
  static std::mutex asking;
  const std::scoped_lock one_at_a_time(asking);
  std::vector<cl::Device> devices;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return devices;  // the ICD loader reports "no platform" as an error
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> found;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &found);
    } catch (const cl::Error&) {
      continue;  // a platform without devices
    }
    devices.insert(devices.end(), found.begin(), found.end());
  }
  std::stable_sort(devices.begin(), devices.end(), [](const cl::Device& a, const cl::Device& b) {
    const auto is_gpu = [](const cl::Device& d) {
      return (d.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0;
    };
    return is_gpu(a) && !is_gpu(b);
  });
  return devices;
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

DeviceInfo describe(const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.platform = trimmed(cl::Platform(device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>());
  info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  info.is_gpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0;
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.memory_mb = static_cast<std::size_t>(device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>() >> 20U);
  return info;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Explains why there is no device: three environment variables hide existing ones.
Error noDevice() {
  if (const char* cache = std::getenv("POCL_CACHE_DIR"); cache != nullptr && ::access(cache, W_OK) != 0) {
    return {std::string("No OpenCL device found; compiled kernels cannot be kept in '") + cache + "'.",
            "Set TMPDIR to a folder that can be written to."};
  }
  for (const char* variable : {"POCL_DEVICES", "OCL_ICD_VENDORS"}) {
    const char* value = std::getenv(variable);
    if (value == nullptr) continue;
    return {std::string("No OpenCL device found; ") + variable + " is set to '" + value + "'.",
            std::string("Unset ") + variable +
                ", or install the package pocl-opencl-icd (runs on any CPU) or your GPU's OpenCL driver."};
  }
  return {"No OpenCL device found.",
          "Install the package pocl-opencl-icd (runs on any CPU), or your GPU's OpenCL driver."};
}

/// PoCL's debugging device "basic" deadlocks when commands wait for each other (3.1: the end of one starts
/// the next, which locks the event that its caller has locked).
bool stopsForEver(const cl::Device& device) {
  const DeviceInfo info = describe(device, 0);
  return info.platform == "Portable Computing Language" && info.name.starts_with("basic");
}

Result<cl::Device> unlessItStops(const cl::Device& device) {
  if (!stopsForEver(device)) return device;
  return fail("The OpenCL device " + describe(device, 0).name + " stops for ever in the middle of a scan.",
              "Leave out --device, and unset POCL_DEVICES or set it to pthread.");
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
  std::vector<DeviceInfo> infos;
  for (const cl::Device& device : allDevices())
    infos.push_back(describe(device, static_cast<int>(infos.size())));
  return infos;
}

Result<cl::Device> chooseDevice(const std::string& requested_by_caller) {
  const char* from_environment = std::getenv("SCANTROVE_DEVICE");
  const std::string requested =
      requested_by_caller.empty() && from_environment != nullptr ? from_environment : requested_by_caller;
  const std::vector<cl::Device> devices = allDevices();
  if (devices.empty()) return fail(noDevice());
  if (requested.empty()) {
    const auto usable = std::ranges::find_if_not(devices, stopsForEver);
    return unlessItStops(usable != devices.end() ? *usable : devices.front());
  }
  std::size_t index = 0;
  const char* end = requested.data() + requested.size();
  if (const auto [stop, failure] = std::from_chars(requested.data(), end, index);
      failure == std::errc{} && stop == end) {
    if (index < devices.size()) return unlessItStops(devices[index]);
  } else {
    for (const cl::Device& device : devices) {
      if (lowered(describe(device, 0).name).find(lowered(requested)) != std::string::npos)
        return unlessItStops(device);
    }
  }
  std::string known;
  for (const DeviceInfo& info : listDevices()) known += " [" + std::to_string(info.index) + "] " + info.name;
  return fail("No OpenCL device matches '" + requested + "'.", "There are:" + known + ".");
}

}  // namespace scantrove
