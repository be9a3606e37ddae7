#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/compute/opencl.h"

namespace scantrove {

/// One OpenCL device as a person sees it.
struct DeviceInfo {
  int index = 0;  ///< position in the list, what `--device` takes
  std::string name;
  std::string platform;
  std::string version;
  bool is_gpu = false;
  int compute_units = 0;
  std::size_t memory_mb = 0;
};

/// All OpenCL devices, GPUs first, then CPUs; empty when there is no driver at all.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

/// The device that `wanted` names: empty = the first of the list (a GPU, else PoCL); a number = that index;
/// else the first whose name contains it (case-insensitive). Also SCANTROVE_DEVICE is asked when `wanted` is
/// empty. Error: no device at all (names the package to install) or none that matches (names those there
/// are).
[[nodiscard]] Result<cl::Device> chooseDevice(const std::string& requested);

}  // namespace scantrove
